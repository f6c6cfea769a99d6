#include "relief/spectrum_pattern.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <map>

#include "common/error.h"
#include "support/error_messages.h"

namespace gnomon::relief {
namespace {
using ::testing::HasSubstr;
using ::testing::StartsWith;

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
