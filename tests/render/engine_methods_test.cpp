// The methods that engines ship, each against its source's own case or a closed form.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "relief/patterns.h"
#include "render/displaced_rays.h"
#include "render/render_scene.h"
#include "render/soft_light.h"
#include "truth/truth_scenes.h"

namespace gnomon::render {
namespace {

using test::difference;
using test::lightToward;
using test::meanDifference;
using test::randomRelief;
using test::RenderScene;
using test::shareShadowed;

using Parameters = std::map<std::string, double>;

Method methodOf(const std::string& name) {
  return readMethod(methodFile(shaderFolder(), name));
}

/// What the shadow test alone says.
Mask testOf(const RenderScene& scene, const std::string& name, const RenderView& view,
            const Vec3& light, const Parameters& parameters = {}) {
  return scene.test(methodOf(name), view, light, TableFilter::exact, parameters);
}

/// A plane of 96 × 4 texels, a world unit each, whose heights are the same in every row. Its
/// samples lie in the texels' middles along y, `perTexel` of them a texel along x.
struct Profile {
  static constexpr int columns = 96;
  static constexpr int rows = 4;
  static constexpr int perTexel = 8;

  template <typename Height>
  explicit Profile(const Height& height, const horizon::BakeSettings& bake = {4, 96})
      : scene(surface::makePlane(columns, rows, columns / rows, 1), relief(height), bake,
              horizon::TableBits::thirtyTwo) {}

  template <typename Height>
  static relief::Relief relief(const Height& height) {
    std::vector<float> texels;
    for (int j = 0; j < rows; ++j) {
      for (int i = 0; i < columns; ++i) texels.push_back(static_cast<float>(height(i)));
    }
    return {relief::HeightField(columns, rows, texels, relief::Wrap::clamp),
            relief::HeightSpace::world, Vec2(1)};
  }

  [[nodiscard]] std::vector<double> shares(const std::string& name, const Vec3& light,
                                           double radius, const Parameters& parameters = {}) const {
    const Visibility found =
        scene.shares(methodOf(name), view, light, radius, SoftAnswer::own, parameters).test;
    const auto* row = &found.shares[static_cast<std::size_t>(view.height / 2 * view.width)];
    return {row, row + view.width};
  }

  /// Where the light ends toward high x of what is dark beyond `from`, texels.
  [[nodiscard]] double endOfShadow(const std::string& name, const Vec3& light, double from,
                                   const Parameters& parameters = {}) const {
    const Mask mask = testOf(scene, name, view, light, parameters);
    const auto row = static_cast<std::size_t>(view.height / 2 * view.width);
    double end = from;
    for (int i = static_cast<int>(from * perTexel); i < view.width; ++i) {
      if (mask.samples[row + static_cast<std::size_t>(i)] == Shade::shadowed)
        end = place(i) + 0.5 / perTexel;
    }
    return end;
  }

  /// x of a column of samples, texels.
  static double place(int column) { return (column + 0.5) / perTexel; }

  RenderScene scene;
  RenderView view = atlasView(scene.surface, rows* perTexel);
};

/// High up to x = 31.5, 0 from x = 32.5 on.
double cliff(int i) {
  return i < 32 ? 10 : 0;
}

const Vec3 towardLowX = lightToward(180, 30);

// ---- parallax-occlusion

TEST(ParallaxOcclusion, OfACliffIsTheHighestOfItsTaps) {
  const GlContext gl;
  const Profile profile(cliff);
  const std::array<double, 7> weights{12, 10, 8, 6, 4, 2, 1};
  const double way = 10 * std::cos(radians(30));
  // So soft that no tap hides all.
  const std::vector<double> shares =
      profile.shares("parallax-occlusion", towardLowX, radians(1), {{"softening", 0.1}});
  int checked = 0;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const double x = Profile::place(static_cast<int>(i));
    if (x < 32.5) continue;
    double hidden = 0;
    bool isOnTheWall = false;
    for (std::size_t k = 0; k < weights.size(); ++k) {
      const double t = 0.22 + 0.11 * static_cast<double>(k);
      const double tap = x - t * way;
      isOnTheWall = isOnTheWall || (tap > 31.5 && tap < 32.5);
      if (tap <= 31.5) hidden = std::max(hidden, 0.1 * weights[k] * (1 - t));
    }
    if (isOnTheWall) continue;
    ++checked;
    EXPECT_NEAR(shares[i], std::clamp(1 - hidden, 0.0, 1.0), 1e-5) << x;
  }
  EXPECT_GT(checked, 200);
}

/// With many taps and a hard edge a cliff of height H has a shadow of 0.88 H cos θ, not H / tan θ.
TEST(ParallaxOcclusion, EndsAShadowWhereItsLastTapDoes) {
  const GlContext gl;
  const Profile profile(cliff);
  for (const double elevation : {15.0, 30.0, 50.0}) {
    const double end = profile.endOfShadow("parallax-occlusion", lightToward(180, elevation), 32.5,
                                           {{"taps", 500}, {"softening", 1e6}});
    // The wall's foot is at 32.5; a tap over its flank still stands over the ray.
    const double top = 31.5 + 0.88 * 10 * std::cos(radians(elevation));
    EXPECT_GT(end, top - 0.2) << elevation;
    EXPECT_LT(end, top + 0.3) << elevation;
  }
}

// ---- normal-march

/// A ramp of the slope s and the width w: the sum of -N·L gives it 1 / √(1 + s²) of its shadow's
/// length, less a step of the march, since it begins with the point's own.
TEST(NormalMarch, ShortensTheShadowOfARampByTheLengthOfItsNormal) {
  const GlContext gl;
  constexpr int foot = 60;
  constexpr int width = 12;
  for (const double slope : {0.5, 1.0, 2.0}) {
    const Profile profile([&](int i) { return slope * std::clamp(foot - i, 0, width); });
    for (const double elevation : {12.0, 20.0}) {
      const double tangent = std::tan(radians(elevation));
      const double reach = 80;
      const double samples = 800;
      const double length = width * (slope / tangent - 1) / std::sqrt(1 + slope * slope);
      if (length > 30) continue;
      const double end = profile.endOfShadow(
          "normal-march", lightToward(180, elevation), foot + 0.5,
          {{"samples", samples}, {"height_scale", 1}, {"reach", reach / Profile::columns}});
      EXPECT_NEAR(end, foot + 0.5 + length - reach / samples, 0.2) << slope << " " << elevation;
    }
  }
}

/// V = 1 - hardness × height scale × the mean of (1 - place) where the sum is at its highest.
TEST(NormalMarch, ItsShareIsTheMeanOverTheSamplesThatRise) {
  const GlContext gl;
  const auto height = [](int i) { return i < 50 ? 2.0 * (50 - i) : 0.0; };
  const Profile profile(height);
  const double elevation = radians(25);
  const Parameters parameters{
      {"samples", 10}, {"height_scale", 1.5}, {"reach", 0.2}, {"hardness", 0.4}};
  const std::vector<double> shares =
      profile.shares("normal-march", lightToward(180, 25), radians(1), parameters);
  const auto rise = [&](double x) {
    const int below = static_cast<int>(std::floor(x - 0.5));
    const double slope = height(below) - height(below + 1);
    return (slope * std::cos(elevation) - std::sin(elevation)) / std::hypot(1, slope);
  };
  double partly = 0;
  for (int column = 30 * Profile::perTexel; column < 90 * Profile::perTexel; ++column) {
    const double x = Profile::place(column);
    double sum = std::min(rise(x), 0.0);
    double highest = 0;
    double hidden = 0;
    for (int k = 0; k < 10; ++k) {
      const double place = (k + 0.5) * 0.02;  // widths of the map, for a level light
      sum += rise(x - place * 1.5 * std::cos(elevation) * Profile::columns);
      if (sum > highest) hidden += 0.4 * 1.5 * (1 - place);
      highest = std::max(highest, sum);
    }
    const double expected = std::max(1 - hidden / 10, 0.0);
    EXPECT_NEAR(shares[static_cast<std::size_t>(column)], expected, 1e-5) << x;
    partly += expected > 0 && expected < 1 ? 1 : 0;
  }
  EXPECT_GT(partly, 100);
}

// ---- marches over a curved surface

relief::Relief columns() {
  return {relief::makeColumns(64, 64, {32, 6, 2}, 4, relief::Wrap::repeat),
          relief::HeightSpace::world, Vec2(1)};
}

TEST(CurvedRelief, OnAPlaneIsTheReliefMarch) {
  const GlContext gl;
  const RenderScene scene(surface::makePlane(64, 64, 8, 8), randomRelief(64, 64, 4, 3), {4, 24},
                          horizon::TableBits::eight);
  const RenderView view = atlasView(scene.surface, 16);
  for (const Vec3& light : {lightToward(20, 30), lightToward(155, 12), lightToward(200, -5)}) {
    const Mask march = testOf(scene, "relief-march", view, light);
    EXPECT_GT(shareShadowed(march), 0.1);
    EXPECT_LT(difference(testOf(scene, "curved-relief", view, light), march), 1e-3);
  }
}

TEST(BentRayMarch, OnAPlaneIsTheMarchOnTheCircle) {
  const GlContext gl;
  const RenderScene scene(surface::makePlane(64, 64, 8, 8), randomRelief(64, 64, 4, 3), {4, 24},
                          horizon::TableBits::eight);
  const RenderView view = atlasView(scene.surface, 16);
  for (const Vec3& light : {lightToward(20, 30), lightToward(155, 12)}) {
    const Mask march = testOf(scene, "osculating-march", view, light);
    EXPECT_GT(shareShadowed(march), 0.1);
    EXPECT_LT(difference(testOf(scene, "bent-ray-march", view, light), march), 1e-3);
  }
}

/// A sphere has no twist, and its parabola leaves the circle in the fourth order: a quadric is
/// nearly the circle there. The frame that turns is as good.
TEST(CurvedReliefAndBentRays, OnASphereAreNearlyTheMarchOnTheCircle) {
  const GlContext gl;
  const RenderScene scene(surface::makeSphere(60, 1, 1, 16, 16), columns(), {4, 48},
                          horizon::TableBits::eight, 2);
  const RenderView view = atlasView(scene.surface, 12);
  for (const Vec3& light : {lightToward(20, 10), lightToward(180, 12)}) {
    const Mask circle = testOf(scene, "osculating-march", view, light, {{"stride", 0.05}});
    const double flat = difference(testOf(scene, "relief-march", view, light), circle);
    const double quadric =
        difference(testOf(scene, "curved-relief", view, light, {{"steps", 1000}}), circle);
    const double bent =
        difference(testOf(scene, "bent-ray-march", view, light, {{"stride", 0.05}}), circle);
    EXPECT_GT(flat, 0.05);
    EXPECT_LT(quadric, flat / 4);
    EXPECT_LT(bent, flat / 4);
  }
}

/// A plane whose map lies in rings about a centre: straight rays are bent paths over it.
TEST(BentRayMarch, FollowsThePathOverTheMap) {
  const GlContext gl;
  surface::Cage cage = surface::makePlane(96, 48, 48, 24);
  for (Vec3& position : cage.positions) {
    const double angle = position.x / 60;
    position = (60 + position.y) * Vec3(std::sin(angle), std::cos(angle), 0);
  }
  cage.grid.reset();
  const relief::Relief relief{relief::makeCosine(96, 48, {24}, 6, relief::Wrap::repeat),
                              relief::HeightSpace::world, Vec2(1)};
  const RenderScene scene(cage, relief, {4, 96}, horizon::TableBits::eight, 2);
  const RenderView view = atlasView(scene.surface, 6);
  for (const Vec3& light : {lightToward(160, 20), lightToward(20, 14)}) {
    const Mask path = testOf(scene, "geodesic-march", view, light);
    const double straight = difference(testOf(scene, "osculating-march", view, light), path);
    const double bent = difference(testOf(scene, "bent-ray-march", view, light), path);
    EXPECT_GT(shareShadowed(path), 0.1);
    EXPECT_LT(bent, straight / 3);
    EXPECT_GT(straight, 0.01);
  }
}

/// On a saddle whose axes lie across the texture's, x y alone, the quadric of the texture's axes is
/// flat.
TEST(CurvedRelief, DoesNotKnowTheTwistBetweenTheAxes) {
  const GlContext gl;
  std::array<Vec3, 16> points{};
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      const Vec2 place = 8.0 * (Vec2(i, j) / 1.5 - 1.0);
      points[static_cast<std::size_t>(4 * j + i)] = Vec3(place, place.x * place.y / 60);
    }
  }
  const relief::Relief relief{relief::makeColumns(16, 16, {8, 2, 1}, 2, relief::Wrap::clamp),
                              relief::HeightSpace::world, Vec2(1)};
  const RenderScene scene(surface::makeBezier(points, 8, 8), relief, {4, 8},
                          horizon::TableBits::eight);
  const RenderView view = atlasView(scene.surface, 16);
  const Vec3 light = lightToward(45, 20);
  const Mask flat = testOf(scene, "relief-march", view, light);
  EXPECT_LT(difference(testOf(scene, "curved-relief", view, light), flat), 0.01);
  EXPECT_GT(difference(testOf(scene, "osculating-march", view, light), flat), 0.03);
}

// ---- base-shadow-map

TEST(BaseShadowMap, OnAPlaneIsTheReliefMarch) {
  const GlContext gl;
  const RenderScene scene(surface::makePlane(64, 64, 8, 8), randomRelief(64, 64, 4, 3), {4, 24},
                          horizon::TableBits::eight);
  const RenderView view = atlasView(scene.surface, 16);
  for (const Vec3& light : {lightToward(20, 30), lightToward(155, 12), lightToward(290, 3)}) {
    EXPECT_EQ(difference(testOf(scene, "base-shadow-map", view, light),
                         testOf(scene, "relief-march", view, light)),
              0);
    const auto shares = [&](const std::string& name) {
      return scene.shares(methodOf(name), view, light, radians(3)).test;
    };
    EXPECT_EQ(meanDifference(shares("base-shadow-map"), shares("relief-march")), 0);
  }
}

/// A torus without relief: what one side of it throws on the other is the depth map's alone.
TEST(BaseShadowMap, SeesTheBodyItself) {
  const GlContext gl;
  const surface::Cage cage = surface::makeTorus(30, 10, 58, 58);
  const RenderScene scene(cage, test::flatRelief(16, 16), {4, 8}, horizon::TableBits::eight);
  const RenderView view = cameraView(test::cameraAt({90, 90, 20}, {0, 0, 0}, 45, 256), scene.mesh);
  const surface::SampleGrid samples = scene.samples(view);
  const Vec3 light = glm::normalize(Vec3(1, 0.07, 0.3));
  const Mask rays = test::Rays(test::DisplacedScene(cage, test::flatRelief(16, 16), 1), 1)
                        .mask(samples, light, 0.1);
  const auto wrong = [&](const std::string& name) {
    const test::Verdict verdict = test::judge(scene.answer(name, view, light), rays, samples);
    EXPECT_GT(verdict.dark, 300U);
    return static_cast<double>(verdict.wrong) / static_cast<double>(verdict.lit + verdict.dark);
  };
  EXPECT_LT(wrong("base-shadow-map"), 0.02);
  EXPECT_GT(wrong("relief-march"), 0.05);
}

// ---- ambient occlusion

/// A wall of height 40 whose top ends at x = 11.5: on the ground the sky is open above the plane
/// through its top, tan β = k cos φ toward it, k = H / distance.
struct Wall {
  static constexpr double height = 40;
  static constexpr double top = 11.5;
  Profile profile{[](int i) { return i < 12 ? height : 0; }, {64, 400}};

  /// A for the ground's normal: ½ + ∫ cos² β dφ / 2π over the half circle toward the wall
  ///   = ½ (1 + 1 / √(1 + k²)).
  static double openness(double x) { return 0.5 * (1 + 1 / std::hypot(1, height / (x - top))); }
};

TEST(AoShadow, BeforeAWallIsTheConesShare) {
  const GlContext gl;
  const Wall wall;
  for (const double elevation : {5.0, 20.0, 35.0}) {
    const Vec3 light = lightToward(90, elevation);
    const auto cone = wall.profile.shares("ao-shadow", light, radians(1));
    const auto line = wall.profile.shares("ao-micro-shadow", light, radians(1));
    const double sine = std::sin(radians(elevation));
    double partly = 0;
    for (int texel = 15; texel < 80; ++texel) {
      const auto i = static_cast<std::size_t>(texel * Profile::perTexel + Profile::perTexel / 2);
      const double open = Wall::openness(texel + 0.5);
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
  const Wall wall;
  const double radius = radians(8);
  int partly = 0;
  for (const Vec3& toward : {lightToward(180, 40), lightToward(180, 60), lightToward(130, 30)}) {
    const auto shares = wall.profile.shares("ambient-aperture", toward, radius);
    const auto points = wall.profile.shares("ambient-aperture", toward, 0);
    for (int texel = 14; texel < 80; ++texel) {
      const auto i = static_cast<std::size_t>(texel * Profile::perTexel + Profile::perTexel / 2);
      const double lune = pi - std::atan(Wall::height / (texel + 0.5 - Wall::top));
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

// ---- cone-steps

TEST(ConeSteps, OnAPlaneAreTheReliefMarch) {
  const GlContext gl;
  const relief::Relief waves{relief::makeCosine(64, 64, {16}, 10, relief::Wrap::repeat),
                             relief::HeightSpace::world, Vec2(1)};
  const RenderScene scene(surface::makePlane(64, 64, 8, 8), waves, {64, 64},
                          horizon::TableBits::eight);
  const RenderView view = atlasView(scene.surface, 16);
  for (const Vec3& light : {lightToward(20, 25), lightToward(155, 15)}) {
    const Mask march = testOf(scene, "relief-march", view, light, {{"steps", 500}});
    EXPECT_GT(shareShadowed(march), 0.05);
    EXPECT_LT(difference(testOf(scene, "cone-steps", view, light, {{"steps", 500}}), march), 0.02);
    // Fewer steps end before the point: what they call dark may be lit, and nothing is lost.
    const Mask few = testOf(scene, "cone-steps", view, light, {{"steps", 8}});
    EXPECT_GT(shareShadowed(few), shareShadowed(march));
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

// ---- methods that draw the displaced mesh

/// A plane of 48 × 48 texels whose height is 10 up to x = 19.5, as real geometry.
struct DisplacedCliff {
  static constexpr int side = 48;
  test::DisplacedScene scene{surface::makePlane(side, side, 12, 12),
                             test::stepRelief(side, side, 10, [](int i, int) { return i < 20; }),
                             8};

  /// x of the middle row of a view, texels.
  [[nodiscard]] std::vector<double> places(const RenderView& view) const {
    const surface::SampleGrid samples = scene.samples(view);
    std::vector<double> found;
    for (int i = 0; i < view.width; ++i) {
      const auto& sample =
          samples.samples[static_cast<std::size_t>(view.height / 2 * view.width + i)];
      found.push_back(sample.isOnSurface() ? scene.surface.evaluate(sample).position.x + side / 2.0
                                           : -1);
    }
    return found;
  }
};

/// Two flat depths under the filter: the bound of Chebyshev is the share of the farther, so that V
/// rises evenly over the filter's width.
TEST(VarianceShadowMap, OfTwoDepthsIsTheShareOfTheFarther) {
  const GlContext gl;
  const DisplacedCliff cliff;
  const RenderView view = atlasView(cliff.scene.surface, 64);
  const std::vector<double> places = cliff.places(view);
  const int width = 33;
  const double texel = 2 * boundingSphere(cliff.scene.displaced.mesh).radius / 2048;
  for (const double elevation : {35.0, 50.0}) {
    const Visibility shares = cliff.scene
                                  .shares("variance-shadow-map", view, lightToward(180, elevation),
                                          0.01, {{"width", width}})
                                  .test;
    const double end = 19.5 + 10 / std::tan(radians(elevation));
    int partly = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (places[i] < 22) continue;
      const double across = (places[i] - end) * std::sin(radians(elevation));
      const double expected = std::clamp(0.5 + across / (width * texel), 0.0, 1.0);
      const float found = shares.shares[static_cast<std::size_t>(view.height / 2 * view.width) + i];
      EXPECT_NEAR(found, expected, 0.05) << places[i];
      partly += expected > 0.1 && expected < 0.9 ? 1 : 0;
    }
    EXPECT_GT(partly, 10);
  }
}

TEST(VarianceShadowMap, StretchesWhatBleedingLeaves) {
  const GlContext gl;
  const DisplacedCliff cliff;
  const RenderView view = atlasView(cliff.scene.surface, 32);
  const auto shares = [&](double bleeding) {
    return cliff.scene
        .shares("variance-shadow-map", view, lightToward(180, 40), 0.01,
                {{"width", 65}, {"bleeding", bleeding}})
        .test.shares;
  };
  const auto all = shares(0);
  const auto cut = shares(0.4);
  int partly = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_NEAR(cut[i], std::clamp((all[i] - 0.4) / 0.6, 0.0, 1.0), 1e-4);
    partly += cut[i] > 0.1 && cut[i] < 0.9 ? 1 : 0;
  }
  EXPECT_GT(partly, 20);
}

/// From above, 110 over the ground: a ray that passes below the cliff's top by more than an eighth
/// of the thickness is stopped, since a sample shades all within 7/8 of its middle's distance. Two
/// of the four rows must be, a pixel apart, and the first sample is up to a pixel behind the edge.
TEST(ScreenSpace, EndsAWallsShadowWhereTheThicknessSays) {
  const GlContext gl;
  const DisplacedCliff cliff;
  const RenderView view =
      cameraView(test::cameraAt({0, 0, 110}, {0, 0, 0}, 30, 192), cliff.scene.displaced.mesh);
  const std::vector<double> places = cliff.places(view);
  const auto endOf = [&](double thickness, double samples) {
    const Mask mask = cliff.scene
                          .answers("screen-space", view, lightToward(180, 45),
                                   {{"thickness", thickness}, {"samples", samples}})
                          .test;
    double end = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const auto row = static_cast<std::size_t>(view.height / 2 * view.width);
      if (mask.samples[row + i] == Shade::shadowed) end = std::max(end, places[i]);
    }
    return end;
  };
  const double pixel = 110 * 2 * std::tan(radians(15)) / 192;
  for (const double thickness : {0.02, 0.05, 0.15}) {
    EXPECT_NEAR(endOf(thickness, 120), 29.5 - thickness / 8 * 105 - 2 * pixel, pixel) << thickness;
  }
  // As many pixels as samples, the last of which fade.
  EXPECT_LT(endOf(0.05, 16), 19.5 + 17 * pixel);
  EXPECT_GT(endOf(0.05, 16), 19.5 + 6 * pixel);
}

}  // namespace
}  // namespace gnomon::render
