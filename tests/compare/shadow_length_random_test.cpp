// Shadow lengths of random masks, against texts, turned pictures and one candidate at a time.

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "compare/masks.h"
#include "compare/shadow_length.h"
#include "compare/uniform_field.h"

namespace gnomon::compare {
namespace {

using test::uniformField;

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
