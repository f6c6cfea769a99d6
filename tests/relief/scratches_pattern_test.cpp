#include "relief/scratches_pattern.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "support/error_messages.h"

namespace gnomon::relief {
namespace {
using ::testing::StartsWith;

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

}  // namespace
}  // namespace gnomon::relief
