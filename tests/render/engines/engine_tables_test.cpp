// Methods of engines that bake, each against its source's own case or a closed form.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "render/displaced_rays.h"
#include "render/engines/engine_methods.h"
#include "render/soft/soft_light.h"

namespace gnomon::render {
namespace {

using test::cliff;
using test::lightToward;
using test::methodOf;
using test::Profile;
using test::RenderScene;
using test::testOf;

// ---- ambient occlusion

/// A wall of height 40 whose top ends at x = 11.5: on the ground the sky is open above the plane
/// through its top, tan β = k cos φ toward it, k = H / distance.
struct HighWall {
  static constexpr double height = 40;
  static constexpr double top = 11.5;
  Profile profile{[](int i) { return i < 12 ? height : 0; }, {64, 400}};

  /// A for the ground's normal: ½ + ∫ cos² β dφ / 2π over the half circle toward the wall
  ///   = ½ (1 + 1 / √(1 + k²)).
  static double openness(double x) { return 0.5 * (1 + 1 / std::hypot(1, height / (x - top))); }
};

TEST(AoShadow, BeforeAWallIsTheConesShare) {
  const GlContext gl;
  const HighWall wall;
  for (const double elevation : {5.0, 20.0, 35.0}) {
    const Vec3 light = lightToward(90, elevation);
    const auto cone = wall.profile.shares("ao-shadow", light, radians(1));
    const auto line = wall.profile.shares("ao-micro-shadow", light, radians(1));
    const double sine = std::sin(radians(elevation));
    double partly = 0;
    for (int texel = 15; texel < 80; ++texel) {
      const auto i = static_cast<std::size_t>(texel * Profile::perTexel + Profile::perTexel / 2);
      const double open = HighWall::openness(texel + 0.5);
      const double ratio = std::min(sine / std::sqrt(1 - open), 1.0);
      // Codes are 1/255 apart, azimuths 64.
      EXPECT_NEAR(cone[i], ratio * ratio, 0.02) << texel << " " << elevation;
      EXPECT_NEAR(line[i], std::clamp(sine + 2 * open * open - 1, 0.0, 1.0), 0.02)
          << texel << " " << elevation;
      partly += ratio < 1 ? 1 : 0;
    }
    EXPECT_GT(partly, 10) << elevation;
  }
}

/// On an even slope the sky is the whole half space over it: a light 10° over it casts no shadow.
/// On the side of a valley the normal leans: A by quadrature over the sky, between the slope itself
/// and the other side's.
TEST(AoShadow, OnTheSideOfAValleyIsTheConesShare) {
  const GlContext gl;
  const Profile profile([](int i) { return std::abs(i - 48); }, {64, 400});
  const Vec3 normal = glm::normalize(Vec3(1, 0, 1));
  int partly = 0;
  for (const int texel : {10, 25, 40}) {
    const double across = static_cast<double>(47 - (48 - texel)) / (95 - texel);
    double open = 0;
    constexpr int steps = 360;
    for (int m = 0; m < steps; ++m) {
      const double azimuth = 2 * pi * (m + 0.5) / steps;
      const double c = std::cos(azimuth);
      const double horizon = std::atan(c < 0 ? -c : across * c);
      for (int k = 0; k < steps; ++k) {
        const double up = horizon + (pi / 2 - horizon) * (k + 0.5) / steps;
        const Vec3 ray(std::cos(up) * c, std::cos(up) * std::sin(azimuth), std::sin(up));
        open += glm::dot(normal, ray) * std::cos(up) * (pi / 2 - horizon) / steps * 2 / steps;
      }
    }
    for (const double elevation : {10.0, 25.0}) {
      const Vec3 light = lightToward(90, elevation);
      const auto cone = profile.shares("ao-shadow", light, radians(1));
      const double ratio = std::min(glm::dot(normal, light) / std::sqrt(1 - open), 1.0);
      const auto i = static_cast<std::size_t>(texel * Profile::perTexel + Profile::perTexel / 2);
      EXPECT_NEAR(cone[i], ratio * ratio, 0.02) << texel << " " << elevation << " " << open;
      partly += ratio < 1 ? 1 : 0;
    }
  }
  EXPECT_GT(partly, 3);
}

TEST(AoShadow, OfAnEvenSlopeIsOpen) {
  const GlContext gl;
  const Profile profile([](int i) { return 0.7 * i; }, {64, 48});
  const double slope = std::atan(0.7) * 180 / pi;
  const auto shares = profile.shares("ao-shadow", lightToward(0, slope + 10), radians(1));
  EXPECT_GT(shares[48 * Profile::perTexel + 4], 0.99);
}

// ---- horizons in few numbers

/// Lights between which the middle of a relief turns from dark to lit: the horizon's elevation
/// there, degrees.
double horizonOf(const RenderScene& scene, const std::string& name, double azimuth,
                 std::size_t sample, const RenderView& view) {
  double low = -5;
  double high = 85;
  while (high - low > 0.05) {
    const double middle = (low + high) / 2;
    const Mask mask = testOf(scene, name, view, lightToward(azimuth, middle));
    (mask.samples[sample] == Shade::shadowed ? low : high) = middle;
  }
  return (low + high) / 2;
}

/// Heights over a map of 65 × 65 texels, of which the middle is asked.
struct Pit {
  static constexpr int side = 65;
  template <typename Height>
  explicit Pit(const Height& height)
      : scene(surface::makePlane(side, side, 13, 13), relief(height), {64, 30},
              horizon::TableBits::thirtyTwo) {}
  template <typename Height>
  static relief::Relief relief(const Height& height) {
    std::vector<float> texels;
    for (int j = 0; j < side; ++j) {
      for (int i = 0; i < side; ++i) {
        texels.push_back(static_cast<float>(height(Vec2(i - side / 2, j - side / 2))));
      }
    }
    return {relief::HeightField(side, side, texels, relief::Wrap::clamp),
            relief::HeightSpace::world, Vec2(1)};
  }
  [[nodiscard]] double horizon(const std::string& name, double azimuth) const {
    return horizonOf(scene, name, azimuth, static_cast<std::size_t>(side / 2 * side + side / 2),
                     view);
  }
  RenderScene scene;
  RenderView view = atlasView(scene.surface, 5);  // one sample a texel, at its centre
};

/// In the middle of a cone with a flat bottom the horizon is as high all around: the series is its
/// first term. Five coefficients are off by half a code of 2/255 each, and β by 2 g / cos β times
/// that.
TEST(RadialFourier, ReproducesAnEvenHorizon) {
  const GlContext gl;
  for (const double slope : {0.2, 1.0}) {
    const Pit pit([&](Vec2 at) { return glm::length(at) < 4 ? 0 : slope * glm::length(at); });
    const double angle = std::atan(slope);
    const double off = 2 * std::sqrt(std::sin(angle)) / std::cos(angle) * 5 / 255;
    for (const double azimuth : {0.0, 77.0, 200.0}) {
      EXPECT_NEAR(pit.horizon("radial-fourier", azimuth), angle * 180 / pi, off * 180 / pi)
          << slope;
    }
  }
}

/// Over a V along x the horizon is √sin β = g(φ), of which five coefficients are left: by
/// quadrature.
TEST(RadialFourier, IsTheSeriesOfItsHorizon) {
  const GlContext gl;
  const Pit pit([](Vec2 at) { return std::abs(at.y); });
  const auto wave = [](double azimuth) {
    const double slope = std::abs(std::sin(azimuth));
    return std::sqrt(slope / std::hypot(1, slope));
  };
  const int count = 3600;
  std::array<double, 3> sums{};  // of 1, sin 2φ, cos 2φ; the odd ones are 0
  for (int k = 0; k < count; ++k) {
    const double azimuth = 2 * pi * (k + 0.5) / count;
    sums[0] += wave(azimuth) / count;
    sums[1] += 2 * wave(azimuth) * std::sin(2 * azimuth) / count;
    sums[2] += 2 * wave(azimuth) * std::cos(2 * azimuth) / count;
  }
  for (const double degrees : {0.0, 20.0, 60.0, 90.0, 130.0}) {
    const double azimuth = radians(degrees);
    const double g = sums[0] + sums[1] * std::sin(2 * azimuth) + sums[2] * std::cos(2 * azimuth);
    EXPECT_NEAR(pit.horizon("radial-fourier", degrees), std::asin(g * std::abs(g)) * 180 / pi, 1)
        << degrees;
  }
}

/// Beside a rising plane the horizon is 45° toward it and 0 at the three other azimuths.
TEST(FourAzimuths, AreLinearInTheAngleBetweenThem) {
  const GlContext gl;
  const Pit pit([](Vec2 at) { return std::max(at.y, 0.0); });
  for (const double azimuth : {0.0, 18.0, 45.0, 72.0, 90.0, 144.0, 200.0, 333.0}) {
    const double expected = std::max(45 * (1 - std::abs(azimuth / 90 - 1)), 0.0);
    EXPECT_NEAR(pit.horizon("four-azimuths", azimuth), expected, 0.7) << azimuth;
  }
}

// ---- ambient-aperture

/// Before a wall the open sky is a lune of the angle ψ = π - β about the wall's direction: its
/// solid angle is 2ψ, so that cos r = 1 - ψ / π, and its mean direction halves it.
TEST(AmbientAperture, BeforeAWallIsTheCapOfALune) {
  const GlContext gl;
  const HighWall wall;
  const double radius = radians(8);
  int partly = 0;
  for (const Vec3& toward : {lightToward(180, 40), lightToward(180, 60), lightToward(130, 30)}) {
    const auto shares = wall.profile.shares("ambient-aperture", toward, radius);
    const auto points = wall.profile.shares("ambient-aperture", toward, 0);
    for (int texel = 14; texel < 80; ++texel) {
      const auto i = static_cast<std::size_t>(texel * Profile::perTexel + Profile::perTexel / 2);
      const double lune = pi - std::atan(HighWall::height / (texel + 0.5 - HighWall::top));
      const double cap = std::acos(1 - lune / pi);
      const Vec3 centre(std::cos(lune / 2), 0, std::sin(lune / 2));
      const double apart = std::acos(glm::dot(centre, toward));
      const double x = std::clamp((cap + radius - apart) / (2 * radius), 0.0, 1.0);
      // A code of the direction is 2/255, 0.45°, and V falls by 3/4 in a radius of 8°.
      EXPECT_NEAR(shares[i], x * x * (3 - 2 * x), 0.06) << texel;
      if (std::abs(apart - cap) > radians(0.7)) {
        EXPECT_EQ(points[i], apart < cap ? 1 : 0) << texel;
      }
      partly += x > 0.2 && x < 0.8 ? 1 : 0;
    }
  }
  EXPECT_GT(partly, 15);
}

/// Of a light larger than the cap that is open, V is the cap's share of it.
TEST(AmbientAperture, OfALargerLightIsTheShareOfTheCap) {
  const GlContext gl;
  const Pit pit([](Vec2 at) { return glm::length(at) < 3 ? 0.0 : 30.0; });
  const auto middle = static_cast<std::size_t>(Pit::side / 2 * Pit::side + Pit::side / 2);
  double sines = 0;  // of the horizons all around
  for (std::size_t m = 0; m < 64; ++m) {
    const double slope = pit.scene.tables.horizon[m * Pit::side * Pit::side + middle];
    sines += slope / std::hypot(1, slope) / 64;
  }
  const double found =
      pit.scene.shares(methodOf("ambient-aperture"), pit.view, {0, 0, 1}, radians(10))
          .test.shares[middle];
  const double code = 1.0 / 255;
  EXPECT_NEAR(found, (1 - sines) / (1 - std::cos(radians(10))),
              0.5 * code / (1 - std::cos(radians(10))) + 1e-3);
}

// ---- log-distance-horizon

/// Averages of an even slope are the slope's.
TEST(LogDistanceHorizon, OfAnEvenSlopeIsTheSlope) {
  const GlContext gl;
  const Profile profile([](int i) { return 0.4 * i; });
  const double slope = std::atan(0.4) * 180 / pi;
  const double found =
      horizonOf(profile.scene, "log-distance-horizon", 0, 8 * 16 * 24 + 8 * 20, profile.view);
  EXPECT_NEAR(found, slope, 0.5);
}

/// Behind a high plain the shadow ends where the light says, up to the samples' distances and the
/// blur of what is far.
TEST(LogDistanceHorizon, FindsAPlainsEdge) {
  const GlContext gl;
  const Profile profile([](int i) { return i < 48 ? 6 : 0; });
  for (const double elevation : {45.0, 20.0, 12.0}) {
    const double end = profile.endOfShadow("log-distance-horizon", lightToward(180, elevation),
                                           48.5, {{"per_octave", 16}});
    const double length = 6 / std::tan(radians(elevation));
    EXPECT_NEAR(end - 47.5, length, 0.15 * length + 0.5) << elevation;
  }
}

TEST(LogDistanceHorizon, UnderADiscIsNearTheClosedForm) {
  const GlContext gl;
  const Profile profile([](int i) { return 0.4 * i; }, {4, 40});
  const double horizon = std::atan(0.4);
  for (const double over : {-2.0, -1.0, 0.0, 1.5}) {
    const auto shares = profile.shares("log-distance-horizon",
                                       lightToward(0, horizon * 180 / pi + over), radians(3));
    EXPECT_NEAR(shares[20 * Profile::perTexel], test::shareOver(radians(over), radians(3)), 0.02);
  }
  // Along a steep slope the horizon is tilted: half of the disc is behind it.
  const Profile steep([](int i) { return 1.5 * i; }, {4, 40});
  const Vec3 normal = glm::normalize(Vec3(-1.5, 0, 1));
  for (const double elevation : {0.5, 2.0}) {
    const Vec3 light = lightToward(90, elevation);
    const auto shares = steep.shares("log-distance-horizon", light, radians(3));
    EXPECT_NEAR(shares[20 * Profile::perTexel],
                test::shareOver(std::asin(glm::dot(normal, light)), radians(3)), 0.05);
  }
}

// ---- shadow-heights

/// A cliff whose top ends at x = 31.5: from it the two heights fall to the middle of texel x as the
/// disc's lowest and highest ray do, and V is linear between them.
TEST(ShadowHeights, BehindACliffAreThoseOfTheDiscsRays) {
  const GlContext gl;
  const Profile profile(cliff);
  const double radius = 3;
  for (const double elevation : {20.0, 30.0, 50.0}) {
    const auto shares =
        profile.shares("shadow-heights", lightToward(180, elevation), radians(radius));
    const double low = std::tan(radians(elevation - radius));
    const double high = std::tan(radians(elevation + radius));
    const auto ends = [&](int texel) {
      const double behind = texel + 0.5 - 31.5;
      return Vec2(std::max(10 - behind * low, -low), std::max(10 - behind * high, -high));
    };
    int partly = 0;
    for (int i = 34 * Profile::perTexel; i < 90 * Profile::perTexel; ++i) {
      const double place = Profile::place(i) - 0.5;
      const int texel = static_cast<int>(place);
      const Vec2 at = glm::mix(ends(texel), ends(texel + 1), place - texel);
      const double share = std::clamp(-at.y / (at.x - at.y), 0.0, 1.0);
      EXPECT_NEAR(shares[static_cast<std::size_t>(i)], share, 1e-3) << place << " " << elevation;
      partly += share > 0 && share < 1 ? 1 : 0;
    }
    EXPECT_GT(partly, 10) << elevation;
    const double end = profile.endOfShadow("shadow-heights", lightToward(180, elevation), 32.5);
    EXPECT_NEAR(end, 31.5 + 10 / std::tan(radians(elevation)), 0.3) << elevation;
  }
}

}  // namespace
}  // namespace gnomon::render
