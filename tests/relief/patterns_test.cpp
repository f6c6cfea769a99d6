#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <map>

#include "common/error.h"
#include "relief/patterns.h"
#include "support/error_messages.h"

namespace gnomon::relief {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr double inf = std::numeric_limits<double>::infinity();

struct NamedField {
  std::string name;
  HeightField field;
};

/// All patterns on a map that holds a whole number of periods, 3 (odd) up and 4 across.
std::vector<NamedField> allPatterns(double amplitude) {
  return {{"columns", makeColumns(128, 96, {}, amplitude, Wrap::repeat)},
          {"cosine", makeCosine(128, 96, {}, amplitude, Wrap::repeat)},
          {"cells", makeCells(128, 96, {}, amplitude, Wrap::repeat)},
          {"ripples", makeRipples(128, 96, {}, amplitude, Wrap::repeat)}};
}

/// The largest difference between the texels of two neighbouring columns, or rows.
double largestJump(const HeightField& field, int i, bool alongX) {
  double most = 0;
  for (int j = 0; j < (alongX ? field.height() : field.width()); ++j) {
    const float here = alongX ? field.texel(i, j) : field.texel(j, i);
    const float next = alongX ? field.texel(i + 1, j) : field.texel(j, i + 1);
    most = std::max(most, std::abs(static_cast<double>(next) - here));
  }
  return most;
}

TEST(Patterns, RiseFromAboutZeroToAboutTheAmplitude) {
  for (const auto& [name, field] : allPatterns(5)) {
    EXPECT_GE(field.minimum(), 0) << name;
    EXPECT_LT(field.minimum(), 0.15) << name;
    EXPECT_LE(field.maximum(), 5) << name;
    EXPECT_GT(field.maximum(), 4.5) << name;
  }
}

TEST(Patterns, ScaleWithTheAmplitude) {
  const auto one = allPatterns(1);
  const auto minusTwo = allPatterns(-2);
  for (std::size_t p = 0; p < one.size(); ++p) {
    for (std::size_t i = 0; i < one[p].field.texels().size(); ++i) {
      ASSERT_EQ(minusTwo[p].field.texels()[i], -2 * one[p].field.texels()[i]) << one[p].name;
    }
  }
}

TEST(Patterns, HaveNoSeamWherePeriodsFit) {
  for (const auto& [name, field] : allPatterns(1)) {
    double inX = 0;
    double inY = 0;
    for (int i = 0; i + 1 < field.width(); ++i) inX = std::max(inX, largestJump(field, i, true));
    for (int j = 0; j + 1 < field.height(); ++j) inY = std::max(inY, largestJump(field, j, false));
    EXPECT_LE(largestJump(field, field.width() - 1, true), inX) << name;
    EXPECT_LE(largestJump(field, field.height() - 1, false), inY) << name;
    EXPECT_GT(inX, 0) << name;
  }
}

TEST(Patterns, CellsContinueAcrossTheSeam) {
  // The same points on a map twice as large would not repeat, but the first map's border must look
  // like any other place: compare second differences, which a hidden cut would raise.
  for (const int up : {1, 2, 3, 5}) {
    const HeightField field = makeCells(128, 32 * up, {}, 1, Wrap::repeat);
    const auto bend = [&](int j) {
      double most = 0;
      for (int i = 0; i < field.width(); ++i) {
        most = std::max<double>(
            most, std::abs(field.texel(i, j - 1) - 2 * field.texel(i, j) + field.texel(i, j + 1)));
      }
      return most;
    };
    double inside = 0;
    for (int j = 1; j + 1 < field.height(); ++j) inside = std::max(inside, bend(j));
    EXPECT_LE(bend(0), inside * 1.05) << up;
    EXPECT_LE(bend(field.height() - 1), inside * 1.05) << up;
  }
}

TEST(Patterns, ColumnsAreCylindersWithLinearWalls) {
  const HeightField field = makeColumns(64, 64, {32, 8, 2}, 3, Wrap::repeat);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const double dx = std::fmod(x + 0.5, 32) - 16;
      const double dy = std::fmod(y + 0.5, 32) - 16;
      const double share = std::clamp((10 - std::sqrt(dx * dx + dy * dy)) / 2, 0.0, 1.0);
      ASSERT_NEAR(field.texel(x, y), 3 * share, 1e-6) << x << " " << y;
    }
  }
  const HeightField steep = makeColumns(32, 32, {32, 8, 0}, 1, Wrap::repeat);
  for (const float h : steep.texels()) EXPECT_TRUE(h == 0 || h == 1);
}

TEST(Patterns, CosineIsItsFormula) {
  const HeightField field = makeCosine(20, 10, {10}, 2, Wrap::repeat);
  EXPECT_NEAR(field.texel(2, 4), 2 * (2 - std::cos(0.5 * pi) - std::cos(0.9 * pi)) / 4, 1e-6);
}

TEST(Patterns, RepeatAfterAPeriod) {
  const HeightField columns = makeColumns(100, 70, {16, 5, 1}, 1, Wrap::clamp);
  const HeightField cosine = makeCosine(100, 70, {16}, 1, Wrap::clamp);
  for (int y = 0; y + 16 < 70; ++y) {
    for (int x = 0; x + 16 < 100; ++x) {
      ASSERT_EQ(columns.texel(x, y), columns.texel(x + 16, y + 16));
      ASSERT_NEAR(cosine.texel(x, y), cosine.texel(x + 16, y), 1e-6);
    }
  }
}

TEST(Patterns, CellsAreOnePlateauAPeriodSquareAndDependOnTheSeed) {
  const HeightField field = makeCells(256, 256, {}, 1, Wrap::repeat);
  // Scales are the connected sets above half the height: 8 × 8 points, one scale each.
  std::vector<bool> seen(field.texels().size());
  int scales = 0;
  for (int start = 0; start < 256 * 256; ++start) {
    std::vector<std::pair<int, int>> open{{start % 256, start / 256}};
    bool counted = false;
    while (!open.empty()) {
      const auto [i, j] = open.back();
      open.pop_back();
      const auto index = static_cast<std::size_t>(wrappedIndex(j, 256, Wrap::repeat) * 256 +
                                                  wrappedIndex(i, 256, Wrap::repeat));
      if (seen[index] || field.texels()[index] < 0.4F) continue;
      seen[index] = counted = true;
      for (const auto& [di, dj] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        open.emplace_back(i + di, j + dj);
      }
    }
    scales += counted ? 1 : 0;
  }
  EXPECT_EQ(scales, 64);
  CellsPattern other;
  other.seed = 2;
  EXPECT_NE(makeCells(256, 256, other, 1, Wrap::repeat).texels(), field.texels());
  EXPECT_EQ(makeCells(256, 256, {}, 1, Wrap::repeat).texels(), field.texels());
}

TEST(Patterns, RipplesAreGentleToWindward) {
  RipplesPattern straight;
  straight.meander = 0;
  straight.period = 80;
  const HeightField field = makeRipples(160, 16, straight, 1, Wrap::repeat);
  double steepestUp = 0;
  double steepestDown = 0;
  int rising = 0;
  for (int x = 0; x < 160; ++x) {
    const double step = field.texel(x + 1, 3) - field.texel(x, 3);
    steepestUp = std::max(steepestUp, step);
    steepestDown = std::max(steepestDown, -step);
    rising += step > 0 ? 1 : 0;
    EXPECT_EQ(field.texel(x, 3), field.texel(x, 12)) << "without meanders crests are straight";
  }
  EXPECT_GT(steepestDown, 1.5 * steepestUp);
  EXPECT_NEAR(rising / 160.0, 0.7, 0.07);
}

TEST(Patterns, RipplesMeanderByNoMoreThanTheySay) {
  RipplesPattern pattern;
  pattern.period = 64;
  pattern.meander = 10;
  const HeightField field = makeRipples(256, 512, pattern, 1, Wrap::repeat);
  // Within 64 texels each row has one crest; unmoved it lies at 0.7 · 64.
  double least = 1e9;
  double most = -1e9;
  for (int y = 0; y < 512; ++y) {
    int crest = 20;
    for (int x = 20; x < 70; ++x) {
      if (field.texel(x, y) > field.texel(crest, y)) crest = x;
    }
    least = std::min(least, crest + 0.5 - 44.8);
    most = std::max(most, crest + 0.5 - 44.8);
  }
  EXPECT_GE(least, -11);
  EXPECT_LE(most, 11);
  EXPECT_GT(most - least, 10);
}

TEST(Patterns, RefuseParametersOutOfRange) {
  struct Case {
    std::string key;
    std::function<void()> make;
  };
  const auto columns = [](ColumnsPattern p) { makeColumns(8, 8, p, 1, Wrap::clamp); };
  const auto cells = [](CellsPattern p) { makeCells(8, 8, p, 1, Wrap::clamp); };
  const auto ripples = [](RipplesPattern p) { makeRipples(8, 8, p, 1, Wrap::clamp); };
  for (const double bad : {0.0, -1.0, inf, -inf, std::nan(""), 1e300, 1e-300}) {
    EXPECT_THAT(messageOf<InputError>([&] { columns({bad, 8, 1}); }), StartsWith("period: "));
    EXPECT_THAT(messageOf<InputError>([&] { cells({bad, 0.7, 3, 1}); }), StartsWith("period: "));
    EXPECT_THAT(messageOf<InputError>([&] { ripples({bad, 0.7, 3}); }), StartsWith("period: "));
    EXPECT_THAT(messageOf<InputError>([&] { makeCosine(8, 8, {bad}, 1, Wrap::clamp); }),
                StartsWith("period: "));
    EXPECT_THAT(messageOf<InputError>([&] { cells({32, 0.7, bad, 1}); }), StartsWith("groove: "));
  }
  for (const double bad : {-0.1, inf, std::nan("")}) {
    EXPECT_THAT(messageOf<InputError>([&] { columns({32, bad, 1}); }), StartsWith("radius: "));
    EXPECT_THAT(messageOf<InputError>([&] { columns({32, 8, bad}); }), StartsWith("wall: "));
    EXPECT_THAT(messageOf<InputError>([&] { cells({32, bad, 3, 1}); }), StartsWith("jitter: "));
    EXPECT_THAT(messageOf<InputError>([&] { ripples({32, 0.7, bad}); }), StartsWith("meander: "));
    EXPECT_THAT(messageOf<InputError>([&] { ripples({32, bad, 3}); }), StartsWith("windward: "));
  }
  EXPECT_THAT(messageOf<InputError>([] { makeCosine(8, 8, {}, std::nan(""), Wrap::clamp); }),
              StartsWith("amplitude: "));
  EXPECT_THAT(messageOf<InputError>([] { makeCosine(0, 8, {}, 1, Wrap::clamp); }),
              HasSubstr("0 × 8"));
  EXPECT_THROW(makeCosine(2000000000, 2000000000, {}, 1, Wrap::clamp), MemoryError);
}

TEST(Patterns, ExtremeParametersStayFinite) {
  EXPECT_NO_THROW(makeCells(16, 16, {1, 1, 1e9, 2147483647}, 1, Wrap::clamp));
  EXPECT_NO_THROW(makeCells(16, 16, {1e9, 0, 1e-3, 0}, 1, Wrap::clamp));
  EXPECT_NO_THROW(makeRipples(1, 1, {1, 0.99, 1e9}, 1, Wrap::clamp));
  EXPECT_NO_THROW(makeColumns(16, 16, {1, 1e9, 1e9}, 1, Wrap::clamp));
  EXPECT_THROW(makeCosine(16, 16, {}, 1e300, Wrap::clamp), InputError);
}

/// So thin that there is one scratch.
constexpr double single = 1e-6;

TEST(ScratchesPattern, OneIsAParabolaAcrossAndAsLongAsItSays) {
  for (const int seed : {1, 2, 3, 4}) {
    const ScratchesPattern made{single, 80, 10, seed};
    const HeightField field = makeScratches(256, 256, made, 1, Wrap::repeat);
    // Its points, unwrapped about the deepest texel, and their weighted covariance: the long axis
    // is the groove's direction.
    const auto deepest = std::min_element(field.texels().begin(), field.texels().end());
    const auto place = static_cast<int>(deepest - field.texels().begin());
    const Vec2 about(place % 256, place / 256);
    std::vector<std::pair<Vec2, double>> points;
    Vec2 middle(0);
    double weight = 0;
    for (int y = -128; y < 128; ++y) {
      for (int x = -128; x < 128; ++x) {
        const double depth = 1 - static_cast<double>(field.texel(static_cast<int>(about.x) + x,
                                                                 static_cast<int>(about.y) + y));
        if (depth <= 0) continue;
        points.emplace_back(Vec2(x, y), depth);
        middle += depth * Vec2(x, y);
        weight += depth;
      }
    }
    middle /= weight;
    double xx = 0;
    double xy = 0;
    double yy = 0;
    for (const auto& [p, depth] : points) {
      const Vec2 d = p - middle;
      xx += depth * d.x * d.x;
      xy += depth * d.x * d.y;
      yy += depth * d.y * d.y;
    }
    const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
    const Vec2 along(std::cos(angle), std::sin(angle));
    double longest = 0;
    for (const auto& [p, depth] : points) {
      longest = std::max(longest, std::abs(glm::dot(p - middle, along)));
    }
    EXPECT_GE(2 * longest, 80.0 / 4 + 10 - 3) << seed;
    EXPECT_LE(2 * longest, 80.0 + 10 + 1) << seed;
    // The profile across, away from the rounded ends: the first scratch has depth 1.
    std::size_t compared = 0;
    for (const auto& [p, depth] : points) {
      if (std::abs(glm::dot(p - middle, along)) > longest - 8) continue;
      const double r = std::abs((p - middle).x * along.y - (p - middle).y * along.x);
      EXPECT_NEAR(depth, std::max(0.0, 1 - r * r / 25), 0.05) << seed;
      ++compared;
    }
    EXPECT_GT(compared, 40U) << seed;
  }
}

TEST(ScratchesPattern, CoverAboutTheirShare) {
  // A share d of the area by random segments leaves e^-d of it whole (Boolean model); the rounded
  // ends add π/4 of a width to every length.
  const double density = 0.5;
  const ScratchesPattern made{density, 40, 4, 1};
  const HeightField field = makeScratches(600, 500, made, 1, Wrap::repeat);
  const auto whole =
      static_cast<double>(std::count(field.texels().begin(), field.texels().end(), 1.0F));
  const double share = density * (1 + 4 * pi / 4 / 25);
  EXPECT_NEAR(whole / static_cast<double>(field.texels().size()), std::exp(-share), 0.02);
}

TEST(ScratchesPattern, TileWhateverTheSides) {
  const HeightField field = makeScratches(101, 67, {1, 60, 12, 2}, 1, Wrap::repeat);
  double inside = 0;
  double across = 0;
  for (int y = 0; y < 67; ++y) {
    for (int x = 0; x < 101; ++x) {
      const double step = std::abs(field.texel(x + 1, y) - field.texel(x, y));
      (x == 100 ? across : inside) = std::max(x == 100 ? across : inside, step);
    }
  }
  EXPECT_LE(across, inside);
  EXPECT_GT(across, 0);
}

TEST(ScratchesPattern, DependOnTheSeedAlone) {
  const auto made = [](int seed) {
    return makeScratches(90, 70, {0.4, 30, 5, seed}, 2, Wrap::repeat).texels();
  };
  EXPECT_EQ(made(1), made(1));
  EXPECT_NE(made(1), made(2));
}

TEST(ScratchesPattern, RefuseParametersOutOfRange) {
  const auto messageFor = [](ScratchesPattern p) {
    return messageOf<InputError>([&] { makeScratches(32, 32, p, 1, Wrap::repeat); });
  };
  EXPECT_THAT(messageFor({0, 60, 4, 1}), StartsWith("density: "));
  EXPECT_THAT(messageFor({5, 60, 4, 1}), StartsWith("density: "));
  EXPECT_THAT(messageFor({0.3, 0.5, 4, 1}), StartsWith("length: "));
  EXPECT_THAT(messageFor({0.3, 60, 20000, 1}), StartsWith("width: "));
  EXPECT_THAT(messageFor({0.3, std::nan(""), 4, 1}), StartsWith("length: "));
}

/// Power |Σ h e^(-2πi (kx/w + ly/h))|² of one wave of a map, by its definition.
double powerOf(const HeightField& field, int k, int l) {
  std::complex<double> sum = 0;
  for (int y = 0; y < field.height(); ++y) {
    for (int x = 0; x < field.width(); ++x) {
      const double turn =
          static_cast<double>(k) * x / field.width() + static_cast<double>(l) * y / field.height();
      sum += static_cast<double>(field.texel(x, y)) * std::polar(1.0, -2 * pi * turn);
    }
  }
  return std::norm(sum);
}

double frequency(const HeightField& field, int k, int l) {
  return std::hypot(static_cast<double>(k) / field.width(),
                    static_cast<double>(l) / field.height());
}

/// The slope of log power against log frequency by least squares, over the waves between two
/// frequencies.
double slopeOf(const HeightField& field, double least, double most) {
  double n = 0;
  double sx = 0;
  double sy = 0;
  double sxx = 0;
  double sxy = 0;
  for (int l = 0; 2 * l <= field.height(); ++l) {
    for (int k = 0; 2 * k <= field.width(); ++k) {
      const double f = frequency(field, k, l);
      if (f < least || f > most) continue;
      const double x = std::log(f);
      const double y = std::log(powerOf(field, k, l));
      n += 1;
      sx += x;
      sy += y;
      sxx += x * x;
      sxy += x * y;
    }
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

TEST(SpectrumPattern, FollowsItsPowerLaw) {
  for (const double beta : {0.0, 1.5, 3.0, 4.0}) {
    // An odd side with a large prime factor too.
    const HeightField field = makeSpectrum(48, 37, {beta, 24, 4, 7}, 1, Wrap::repeat);
    // Floats of texels add white noise of 1e-14 of the map's power.
    EXPECT_NEAR(slopeOf(field, 1.0 / 20, 1.0 / 5), -beta, 0.01) << beta;
  }
}

TEST(SpectrumPattern, HasNoPowerOutsideItsCutOffs) {
  const HeightField field = makeSpectrum(48, 36, {3, 16, 6, 1}, 1, Wrap::repeat);
  double inside = 0;
  double outside = 0;
  for (int l = 0; l <= 18; ++l) {
    for (int k = 0; k <= 24; ++k) {
      if (k == 0 && l == 0) continue;
      const double f = frequency(field, k, l);
      const bool isInside = f >= 1.0 / 16 - 1e-9 && f <= 1.0 / 6 + 1e-9;
      (isInside ? inside : outside) += powerOf(field, k, l);
    }
  }
  EXPECT_GT(inside, 1);
  EXPECT_LT(outside, 1e-9 * inside);
}

/// Waves of exactly 8 texels alone: half a wave along both axes changes the sign of every one.
TEST(SpectrumPattern, IsTheSumOfWaves) {
  const HeightField field = makeSpectrum(16, 16, {3, 8, 8, 5}, 1, Wrap::repeat);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      const double there = field.texel((x + 4) % 16, (y + 4) % 16);
      EXPECT_NEAR(field.texel(x, y) + there, field.texel(0, 0) + field.texel(4, 4), 1e-6);
    }
  }
}

TEST(SpectrumPattern, RunsFromZeroToTheAmplitudeAndDependsOnTheSeed) {
  const HeightField field = makeSpectrum(60, 44, {}, 5, Wrap::repeat);
  EXPECT_EQ(field.minimum(), 0);
  EXPECT_NEAR(field.maximum(), 5, 1e-6);
  EXPECT_EQ(makeSpectrum(60, 44, {}, 5, Wrap::repeat).texels(), field.texels());
  SpectrumPattern other;
  other.seed = 2;
  EXPECT_NE(makeSpectrum(60, 44, other, 5, Wrap::repeat).texels(), field.texels());
}

/// No step where the map meets itself, though no side is a multiple of the period.
TEST(SpectrumPattern, TilesWhateverTheSides) {
  const HeightField field = makeSpectrum(70, 50, {4, 33, 10, 3}, 1, Wrap::repeat);
  double inside = 0;
  double across = 0;
  for (int y = 0; y < 50; ++y) {
    for (int x = 0; x < 70; ++x) {
      const double step = std::abs(field.texel(x + 1, y) - field.texel(x, y));
      (x == 69 ? across : inside) = std::max(x == 69 ? across : inside, step);
    }
  }
  EXPECT_LE(across, 1.1 * inside);
}

TEST(SpectrumPattern, RefusesParametersOutOfRange) {
  const auto messageFor = [](SpectrumPattern p) {
    return messageOf<InputError>([&] { makeSpectrum(32, 32, p, 1, Wrap::repeat); });
  };
  for (const double bad : {-1.0, 10.5, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_THAT(messageFor({bad, 16, 4, 1}), StartsWith("beta: "));
  }
  EXPECT_THAT(messageFor({3, 16, 1.5, 1}), StartsWith("shortest: "));
  EXPECT_THAT(messageFor({3, 3, 4, 1}), StartsWith("period: "));
  EXPECT_THAT(messageFor({3, 5.2, 5.1, 1}), HasSubstr("no wave from 5.1 to 5.2"));
  EXPECT_THROW(makeSpectrum(2000000000, 2000000000, {}, 1, Wrap::repeat), MemoryError);
}

}  // namespace
}  // namespace gnomon::relief
