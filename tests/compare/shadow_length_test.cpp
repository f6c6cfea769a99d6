#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/error.h"
#include "common/vec.h"
#include "compare/drawn_mask.h"
#include "compare/masks.h"
#include "compare/shadow_length.h"
#include "compare/uniform_field.h"

// Shadow lengths of random masks, against texts, turned pictures and one candidate at a time.

namespace gnomon::compare {
namespace {

using test::drawn;
using test::uniformField;

/// The same row again and again: as many runs as rows where the light goes along them.
Mask repeated(std::string_view picture, int rows = 40) {
  const Mask one = test::row(picture);
  Mask mask{one.width, rows, {}};
  for (int i = 0; i < rows; ++i) {
    mask.samples.insert(mask.samples.end(), one.samples.begin(), one.samples.end());
  }
  return mask;
}

/// Candidate and truth as rows, the light's shadows falling to the right.
ShadowLengths compareRows(std::string_view candidate, std::string_view truth) {
  const Mask mask = repeated(candidate);
  return compareShadowLengths(mask, repeated(truth), uniformField(mask.width, mask.height, {1, 0}));
}

/// The ratio that every row has.
double ratioOfRows(std::string_view candidate, std::string_view truth) {
  const ShadowLengths found = compareRows(candidate, truth);
  EXPECT_EQ(found.runs, 40);
  EXPECT_EQ(found.lowerQuartile, found.ratio);
  EXPECT_EQ(found.upperQuartile, found.ratio);
  return found.ratio.value_or(-1);
}

double runsOfRows(std::string_view truth) {
  return compareRows(truth, truth).runs;
}

// ---- lengths by hand

TEST(ShadowLength, ByHand) {
  EXPECT_EQ(ratioOfRows("...######....", "...####......"), 6.0 / 4);
  EXPECT_EQ(ratioOfRows("...##........", "...####......"), 2.0 / 4);
  EXPECT_EQ(ratioOfRows("...####......", "...####......"), 1);
}

TEST(ShadowLength, SumsTheStepsOfItsOwnSamples) {
  const Mask truth = repeated("..####......");
  const Mask candidate = repeated("..######....");
  LightField field = uniformField(12, 40, {1, 0}, 0.25);
  ShadowLengths found = compareShadowLengths(candidate, truth, field);
  EXPECT_EQ(found.truthLength, 1);
  EXPECT_EQ(found.ratio, 1.5);
  // Foreshortened there: a sample of the candidate's tip measures twice as much.
  for (std::size_t i = 0; i < field.steps.size(); ++i) {
    if (i % 12 == 6) field.steps[i].length = 0.5;
  }
  found = compareShadowLengths(candidate, truth, field);
  EXPECT_EQ(found.truthLength, 1);
  EXPECT_EQ(found.ratio, 1.75);
}

TEST(ShadowLength, FollowsTheStepsWhereTheyTurn) {
  // To the right up to column 9, from there down.
  LightField field = uniformField(20, 80, {1, 0});
  for (int row = 0; row < 80; ++row) {
    for (int column = 10; column < 20; ++column) {
      field.steps[static_cast<std::size_t>(row * 20 + column)].away = {0, 1};
    }
  }
  // One block, entered from the left; every line leaves it at its lower end in column 10.
  const Mask truth = drawn(20, 80, [](int x, int y) { return x >= 5 && x <= 10 && y < 45; });
  const ShadowLengths found = compareShadowLengths(truth, truth, field);
  // A line from row y has 5 + (45 - y) samples and 35 behind its end: rows 15 to 44.
  EXPECT_EQ(found.runs, 30);
  EXPECT_EQ(found.truthLength, (35 + 6) / 2.0);
}

/// Bands across a direction, each beginning every `period` and `length` long.
Mask bands(int side, Vec2 away, double period, double length) {
  return drawn(side, side, [&](int column, int row) {
    const double place = glm::dot(Vec2(column, row) - side / 2.0, away) / period;
    return (place - std::floor(place)) * period < length;
  });
}

TEST(ShadowLength, InAnyDirection) {
  constexpr int side = 400;
  constexpr double period = 80;
  constexpr double length = 24;
  for (const double degrees : {0.0, 17.0, 45.0, 61.5, 90.0, 137.0, 200.0, 270.0, 333.0}) {
    const Vec2 away(std::cos(radians(degrees)), std::sin(radians(degrees)));
    const LightField field = uniformField(side, side, away);
    const Mask truth = bands(side, away, period, length);
    for (const double factor : {0.5, 1.0, 1.5, 2.5}) {
      const ShadowLengths found =
          compareShadowLengths(bands(side, away, period, factor * length), truth, field);
      ASSERT_TRUE(found.ratio) << degrees;
      EXPECT_NEAR(*found.truthLength, length, 1) << degrees;
      EXPECT_NEAR(*found.ratio, factor, 2 / length) << degrees;
    }
  }
}

TEST(ShadowLength, HasOneRunASampleOfWidthAcrossTheLight) {
  constexpr int side = 300;
  for (const double degrees : {0.0, 20.0, 30.0, 45.0, 70.0, 113.0, 204.0, 299.0}) {
    const Vec2 away(std::cos(radians(degrees)), std::sin(radians(degrees)));
    const Vec2 across(-away.y, away.x);
    // A rectangle 100 wide across the light and 30 long, in the middle.
    const Mask truth = drawn(side, side, [&](int column, int row) {
      const Vec2 place = Vec2(column, row) - side / 2.0;
      return std::abs(glm::dot(place, across)) < 50 && std::abs(glm::dot(place, away)) < 15;
    });
    const auto found = compareShadowLengths(truth, truth, uniformField(side, side, away));
    // Seventeen lines a sample hit a width to 1/34 of each axis, √2 / 34 of 100 together; and lines
    // along the ragged sides, a sample each, may come in or stay out.
    EXPECT_NEAR(found.runs, 100, 100 * std::sqrt(2) / 34 + 2) << degrees;
  }
}

// ---- which shadow of the candidate belongs to a run

TEST(ShadowLength, OfAMissingShadowIsNone) {
  EXPECT_EQ(ratioOfRows(".............", "...####......"), 0);
  EXPECT_EQ(ratioOfRows("........###..", "...####......"), 0) << "another shadow";
}

TEST(ShadowLength, ASlitCostsItsWidth) {
  EXPECT_EQ(ratioOfRows("...##.#......", "...####......"), 3.0 / 4);
  EXPECT_EQ(ratioOfRows("...#.##.#....", "...####......"), 3.0 / 4) << "not on from its end";
}

TEST(ShadowLength, BeginsWhereTheCandidateDoes) {
  EXPECT_EQ(ratioOfRows(".######......", "...####......"), 6.0 / 4);
  EXPECT_EQ(ratioOfRows(".#.####......", "...####......"), 1) << "a gap before it";
  EXPECT_EQ(ratioOfRows(".##..##......", "...####......"), 2.0 / 4) << "not from its start";
}

TEST(ShadowLength, EndsAtTheNextRun) {
  // All dark: the first run goes on to the second, which gets nothing of what came before it.
  const ShadowLengths all = compareRows("########################", "..####......####........");
  EXPECT_EQ(all.runs, 80);
  EXPECT_EQ(all.lowerQuartile, 12.0 / 4) << "4 + 8 behind it, and the same of the other";
  const ShadowLengths joined = compareRows("..##############........", "..####......####........");
  EXPECT_EQ(joined.lowerQuartile, 1) << "the second run";
  EXPECT_EQ(joined.upperQuartile, 10.0 / 4) << "the first run";
}

// ---- what is left out

TEST(ShadowLength, LeavesOutWhatMeetsAnEdge) {
  EXPECT_EQ(runsOfRows("..####...."), 40);
  EXPECT_EQ(runsOfRows("####......"), 0) << "began outside";
  EXPECT_EQ(runsOfRows("......####"), 0) << "ends outside";
  EXPECT_EQ(runsOfRows("...####..."), 0) << "less than its own length behind it";
  EXPECT_EQ(runsOfRows("...####.####......."), 80) << "the next one begins";
  EXPECT_EQ(runsOfRows(" ####......"), 0);
  EXPECT_EQ(runsOfRows("..#### ..........."), 0);
  EXPECT_EQ(runsOfRows("..####... ........"), 0);
  EXPECT_EQ(runsOfRows("..## ##..........."), 0);
}

TEST(ShadowLength, LeavesOutShortRuns) {
  EXPECT_EQ(runsOfRows("..###......"), 0);
  EXPECT_EQ(runsOfRows("..####....."), 40);
}

TEST(ShadowLength, LeavesTheSameRunsOutForAnyCandidate) {
  for (const char* candidate : {"............", "############", "...#########"}) {
    EXPECT_EQ(compareRows(candidate, "..####......").runs, 40) << candidate;
  }
}

TEST(ShadowLength, EndsWhereThereIsNoDirection) {
  const Mask truth = repeated("...####.......");
  for (const int column : {2, 3, 4, 6, 8, 10}) {
    LightField field = uniformField(14, 40, {1, 0});
    for (int row = 0; row < 40; ++row) {
      field.steps[static_cast<std::size_t>(row * 14 + column)].away = {0, 0};
    }
    EXPECT_EQ(compareShadowLengths(truth, truth, field).runs, 0) << column;
  }
  LightField field = uniformField(14, 40, {1, 0});
  for (std::size_t i = 11; i < field.steps.size(); i += 14) field.steps[i].away = {0, 0};
  EXPECT_EQ(compareShadowLengths(truth, truth, field).runs, 40) << "behind all that is needed";
}

TEST(ShadowLength, DoesNotCrossTiles) {
  const Mask truth = repeated("..####......####....");
  const auto runs = [&](int side) {
    LightField field = uniformField(20, 40, {1, 0});
    field.tileSide = side;
    return compareShadowLengths(truth, truth, field).runs;
  };
  EXPECT_EQ(runs(0), 80);
  EXPECT_EQ(runs(10), 80);
  EXPECT_EQ(runs(12), 40) << "the second begins at a border";
  EXPECT_EQ(runs(8), 0);
  // Along rows nothing is crossed; along columns it is.
  const Mask down = drawn(40, 20, [](int, int y) { return y >= 2 && y < 6; });
  LightField field = uniformField(40, 20, {0, 1});
  EXPECT_EQ(compareShadowLengths(down, down, field).runs, 40);
  field.tileSide = 4;
  EXPECT_EQ(compareShadowLengths(down, down, field).runs, 0);
}

TEST(ShadowLength, DoesNotCrossABreakInTheSurface) {
  const Mask truth = repeated("..####......####....");
  for (const int column : {4, 8}) {
    LightField field = uniformField(20, 40, {1, 0});
    for (std::size_t i = 0; i < field.steps.size(); ++i) {
      if (static_cast<int>(i % 20) >= column) field.steps[i].place.z = 50;
    }
    EXPECT_EQ(compareShadowLengths(truth, truth, field).runs, 40) << "the second only";
    // A sample that reaches that far does not help if its neighbour does not.
    for (std::size_t i = 0; i < field.steps.size(); ++i) {
      if (static_cast<int>(i % 20) < column) field.steps[i].spacing = 1000;
    }
    EXPECT_EQ(compareShadowLengths(truth, truth, field).runs, 40);
    for (LightStep& step : field.steps) step.spacing = 1000;
    EXPECT_EQ(compareShadowLengths(truth, truth, field).runs, 80);
  }
}

TEST(ShadowLength, DoesNotGoRoundInRings) {
  // Every line from the left is sent back by the right half.
  LightField field = uniformField(20, 40, {1, 0});
  for (std::size_t i = 0; i < field.steps.size(); ++i) {
    if (i % 20 >= 10) field.steps[i].away = {-1, 0};
  }
  const Mask truth = repeated("..##################");
  EXPECT_EQ(compareShadowLengths(truth, truth, field).runs, 0);
}

TEST(ShadowLength, TakesRunsWithASelectedSampleOnly) {
  const Mask truth = repeated("..####......####....");
  const LightField field = uniformField(20, 40, {1, 0});
  std::vector<std::uint8_t> selected(truth.size(), 0);
  EXPECT_EQ(compareShadowLengths(truth, truth, field, selected).runs, 0);
  for (std::size_t i = 5; i < selected.size(); i += 20) selected[i] = 1;  // the first one's last
  for (std::size_t i = 8; i < selected.size(); i += 20) selected[i] = 1;  // lit
  EXPECT_EQ(compareShadowLengths(truth, truth, field, selected).runs, 40);
  selected.assign(truth.size(), 2);
  EXPECT_EQ(compareShadowLengths(truth, truth, field, selected).runs, 80);
}

// ---- statistics

TEST(ShadowLength, QuartilesOverAllRuns) {
  // 40 rows of 8 shadowed samples; the candidate has 0 to 7 of them, five rows each.
  const Mask truth = repeated("..########........");
  const Mask candidate = drawn(18, 40, [](int x, int y) { return x >= 2 && x < 2 + y % 8; });
  const ShadowLengths found = compareShadowLengths(candidate, truth, uniformField(18, 40, {1, 0}));
  // In order: five of each; places 9.75, 19.5 and 29.25 of 0 to 39.
  EXPECT_DOUBLE_EQ(*found.lowerQuartile, 1.75 / 8);
  EXPECT_DOUBLE_EQ(*found.ratio, 3.5 / 8);
  EXPECT_DOUBLE_EQ(*found.upperQuartile, 5.25 / 8);
}

TEST(ShadowLength, OfFewRunsIsUndefined) {
  const auto rows = [](int count) {
    const Mask truth = repeated("..####......", count);
    return compareShadowLengths(truth, truth, uniformField(12, count, {1, 0}));
  };
  EXPECT_EQ(rows(30).ratio, 1);
  const ShadowLengths few = rows(29);
  EXPECT_EQ(few.runs, 29);
  EXPECT_EQ(few.ratio, std::nullopt);
  EXPECT_EQ(few.lowerQuartile, std::nullopt);
  EXPECT_EQ(few.upperQuartile, std::nullopt);
  EXPECT_EQ(few.truthLength, std::nullopt);
}

TEST(ShadowLength, AsMetrics) {
  ShadowLengths lengths{40, 1.25, 1.0, 1.5, 8.0};
  const auto metrics = lengthMetrics(lengths);
  ASSERT_EQ(metrics.size(), 4U);
  const std::vector<double> values = {1.25, 1.0, 1.5, 40};
  const std::vector<std::string_view> names = {"shadow_length_ratio", "shadow_length_q1",
                                               "shadow_length_q3", "shadow_runs"};
  for (std::size_t i = 0; i < metrics.size(); ++i) {
    EXPECT_EQ(metrics[i].name(), names[i]);
    EXPECT_EQ(metrics[i].value, values[i]);
    EXPECT_EQ(metrics[i].reason, "");
  }
  const auto few = lengthMetrics({12, {}, {}, {}, {}});
  EXPECT_EQ(few[0].value, std::nullopt);
  EXPECT_EQ(few[0].reason, "fewer than 30 cast shadows with both ends in view");
  EXPECT_EQ(few[3].value, 12);
  EXPECT_EQ(lengthMetrics({})[2].reason, "no cast shadow with both ends in view");
  EXPECT_EQ(lengthMetrics({})[3].value, 0);
}

TEST(ShadowLength, RefusesSizesThatDiffer) {
  const Mask mask = repeated("..####......");
  const LightField field = uniformField(12, 40, {1, 0});
  EXPECT_THROW((void)compareShadowLengths(repeated(".."), mask, field), InputError);
  EXPECT_THROW((void)compareShadowLengths(mask, mask, uniformField(40, 12, {1, 0})), InputError);
  LightField cut = field;
  cut.steps.pop_back();
  EXPECT_THROW((void)compareShadowLengths(mask, mask, cut), InputError);
  const std::vector<std::uint8_t> selected(7, 1);
  EXPECT_THROW((void)compareShadowLengths(mask, mask, field, selected), InputError);
  EXPECT_EQ(compareShadowLengths(Mask{}, Mask{}, LightField{}).runs, 0);
}

/// Rows of random stretches of 1 to 9 samples, now and then without an answer; the candidate's
/// edges are the truth's, moved.
struct RandomPair {
  Mask candidate, truth;
};

RandomPair randomPair(int width, int height, std::uint32_t seed) {
  RandomPair pair{{width, height, {}}, {width, height, {}}};
  std::mt19937 random(seed);
  const auto upTo = [&random](int end) {
    return static_cast<int>(random() % static_cast<std::uint32_t>(end));
  };
  const auto stretches = [&](int row) {
    Mask one = test::row(std::string(static_cast<std::size_t>(width), '.'));
    bool dark = row % 2 == 0;
    for (int begin = 0; begin < width;) {
      const int end = std::min(width, begin + 1 + upTo(9));
      for (; begin < end; ++begin) {
        if (dark) one.samples[static_cast<std::size_t>(begin)] = Shade::shadowed;
      }
      dark = !dark;
    }
    return one.samples;
  };
  for (int row = 0; row < height; ++row) {
    auto truth = stretches(row);
    auto candidate = upTo(2) == 0 ? truth : stretches(row);
    const int hole = upTo(4 * width);
    if (hole < width) {
      truth[static_cast<std::size_t>(hole)] = candidate[static_cast<std::size_t>(hole)] =
          Shade::none;
    }
    pair.truth.samples.insert(pair.truth.samples.end(), truth.begin(), truth.end());
    pair.candidate.samples.insert(pair.candidate.samples.end(), candidate.begin(), candidate.end());
  }
  return pair;
}

std::string rowText(const Mask& mask, int row) {
  std::string text;
  for (int column = 0; column < mask.width; ++column) {
    const Shade shade = mask.samples[static_cast<std::size_t>(row * mask.width + column)];
    text += shade == Shade::shadowed ? '#' : shade == Shade::lit ? '.' : ' ';
  }
  return text;
}

/// How far a text is one character on from a place, or back from it.
std::size_t stretchFrom(const std::string& text, std::size_t begin, char character) {
  return std::min(text.find_first_not_of(character, begin), text.size()) - begin;
}
std::size_t stretchBefore(const std::string& text, std::size_t end, char character) {
  std::size_t count = 0;
  while (count < end && text[end - 1 - count] == character) ++count;
  return count;
}

/// The ratios of one row for a light along it, said with texts alone.
void appendRatios(const std::string& candidate, const std::string& truth,
                  std::vector<double>& ratios) {
  for (std::size_t begin = truth.find(".#"); begin != std::string::npos;
       begin = truth.find(".#", begin)) {
    ++begin;
    const std::size_t length = stretchFrom(truth, begin, '#');
    const std::size_t end = begin + length;
    const std::size_t gap = stretchFrom(truth, end, '.');
    const bool nextBegins = end + gap < truth.size() && truth[end + gap] == '#' && gap > 0;
    if (length < 4 || (!nextBegins && gap < length)) continue;
    const std::string own = candidate.substr(begin, length);
    std::size_t sum = static_cast<std::size_t>(std::count(own.begin(), own.end(), '#'));
    if (own.back() == '#') sum += std::min(gap, stretchFrom(candidate, end, '#'));
    if (own.front() == '#') {
      const std::size_t before = stretchBefore(candidate, begin, '#');
      const std::size_t lit = stretchBefore(truth, begin, '.');
      const bool isAnothers = before >= lit && begin > lit && truth[begin - lit - 1] == '#';
      if (!isAnothers) sum += std::min(before, lit);
    }
    ratios.push_back(static_cast<double>(sum) / static_cast<double>(length));
  }
}

TEST(ShadowLengthOfRandomMasks, AgreesWithTextsWhereTheLightGoesAlongRows) {
  EXPECT_TRUE(rc::check([] {
    const RandomPair pair = randomPair(70, 60, *rc::gen::arbitrary<std::uint32_t>());
    std::vector<double> ratios;
    for (int row = 0; row < pair.truth.height; ++row) {
      appendRatios(rowText(pair.candidate, row), rowText(pair.truth, row), ratios);
    }
    const ShadowLengths found =
        compareShadowLengths(pair.candidate, pair.truth, uniformField(70, 60, {1, 0}));
    RC_ASSERT(found.runs == static_cast<double>(ratios.size()));
    RC_ASSERT(ratios.size() >= 30U);
    std::sort(ratios.begin(), ratios.end());
    const std::size_t n = ratios.size();
    const double median = (ratios[(n - 1) / 2] + ratios[n / 2]) / 2;
    RC_ASSERT(std::abs(*found.ratio - median) < 1e-12);
    RC_ASSERT(*found.lowerQuartile <= *found.ratio);
    RC_ASSERT(*found.upperQuartile >= *found.ratio);
  }));
}

TEST(ShadowLengthOfRandomMasks, OfTheTruthItselfIsOneEverywhere) {
  EXPECT_TRUE(rc::check([] {
    const RandomPair pair = randomPair(60, 60, *rc::gen::arbitrary<std::uint32_t>());
    const double angle = radians(*rc::gen::inRange(0, 360));
    LightField field = uniformField(60, 60, {std::cos(angle), std::sin(angle)});
    for (LightStep& step : field.steps) step.length = static_cast<float>(0.1 + step.place.x / 7);
    const ShadowLengths found = compareShadowLengths(pair.truth, pair.truth, field);
    RC_ASSERT(found.runs >= 30);
    RC_ASSERT(found.ratio == 1.0);
    RC_ASSERT(found.lowerQuartile == 1.0);
    RC_ASSERT(found.upperQuartile == 1.0);
  }));
}

/// A quarter turn: what was on the right is at the bottom.
Mask quarterTurned(const Mask& mask) {
  Mask turned = test::transposed(mask);
  for (int row = 0; row < turned.height; ++row) {
    const auto begin = turned.samples.begin() + row * turned.width;
    std::reverse(begin, begin + turned.width);
  }
  return turned;
}

bool isSame(const ShadowLengths& a, const ShadowLengths& b) {
  const auto near = [](std::optional<double> x, std::optional<double> y) {
    return x.has_value() == y.has_value() && (!x || std::abs(*x - *y) < 1e-9);
  };
  return a.runs == b.runs && near(a.ratio, b.ratio) && near(a.lowerQuartile, b.lowerQuartile) &&
         near(a.upperQuartile, b.upperQuartile) && near(a.truthLength, b.truthLength);
}

TEST(ShadowLengthOfRandomMasks, DoesNotDependOnHowThePictureIsTurned) {
  EXPECT_TRUE(rc::check([] {
    const RandomPair pair = randomPair(64, 48, *rc::gen::arbitrary<std::uint32_t>());
    // Not at 45 degrees, where positions fall between samples and rounding has a side.
    const double angle = radians(*rc::gen::inRange(0, 8) * 45 + 17.3);
    const Vec2 away(std::cos(angle), std::sin(angle));
    const ShadowLengths found =
        compareShadowLengths(pair.candidate, pair.truth, uniformField(64, 48, away));
    RC_ASSERT(
        isSame(found, compareShadowLengths(quarterTurned(pair.candidate), quarterTurned(pair.truth),
                                           uniformField(48, 64, {-away.y, away.x}))));
  }));
}

/// More than are compared at once; some without an answer where the truth has one.
TEST(ShadowLengthOfRandomMasks, OfManyCandidatesAtOnceIsThatOfEach) {
  std::mt19937 random(11);
  const Mask truth = randomPair(70, 60, 12).truth;
  std::vector<Mask> masks;
  for (int k = 0; k < 70; ++k) {
    Mask mask = truth;
    for (Shade& shade : mask.samples) {
      if (random() % 100 < static_cast<unsigned>(k)) {
        shade = shade == Shade::lit ? Shade::shadowed : Shade::lit;
      }
      if (k % 10 == 9 && random() % 50 == 0) shade = Shade::none;
    }
    masks.push_back(std::move(mask));
  }
  std::vector<const Mask*> candidates;
  for (const Mask& mask : masks) candidates.push_back(&mask);
  LightField field = uniformField(70, 60, {std::cos(0.3), std::sin(0.3)});
  for (LightStep& step : field.steps) step.length = static_cast<float>(0.1 + step.place.x / 7);
  std::vector<std::uint8_t> selected(truth.size());
  for (std::uint8_t& is : selected) is = random() % 3 == 0 ? 1 : 0;
  const std::vector<ShadowLengths> found = compareShadowLengths(candidates, truth, field, selected);
  ASSERT_EQ(found.size(), masks.size());
  for (std::size_t k = 0; k < masks.size(); ++k) {
    EXPECT_EQ(found[k], compareShadowLengths(masks[k], truth, field, selected)) << k;
  }
  // As many as fit beside each other in words of each size, and one more.
  for (const std::size_t count : {5U, 6U, 13U, 14U}) {
    const auto some = std::span(candidates).first(count);
    const std::vector<ShadowLengths> fewer = compareShadowLengths(some, truth, field, selected);
    EXPECT_TRUE(std::equal(fewer.begin(), fewer.end(), found.begin())) << count;
  }
  EXPECT_NE(found[0], found[30]);
  EXPECT_NE(found[0].runs, found[9].runs);
  EXPECT_TRUE(compareShadowLengths(std::span<const Mask* const>(), truth, field).empty());
}

}  // namespace
}  // namespace gnomon::compare
