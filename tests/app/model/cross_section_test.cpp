#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>

#include "model/cross_section.h"
#include "relief/patterns.h"
#include "render/render_scene.h"
#include "render/soft/soft_light.h"
#include "truth/disc_scenes.h"
#include "truth/truth_scenes.h"

// What the section says of a pixel against what the shaders answered there.

namespace gnomon::app {
namespace {

using test::flatRelief;
using test::lightToward;
using test::randomRelief;
using test::RenderScene;
using test::sampleAt;
using test::shareShadowed;
using test::stepRelief;
using test::wallPlane;
using test::wallRelief;

CrossSection sectionAt(const surface::LimitSurface& surface, const relief::Relief& relief,
                       Vec2 texel, const Vec3& light) {
  return crossSection(surface, relief, sampleAt(surface, relief, texel), light).value();
}

/// Figure 1 on a plane: all corrections vanish, and the wall hides the light below 6 / distance.
TEST(CrossSection, OfAWallOnAPlaneIsFlatAndItsHorizonTheWallsTop) {
  const surface::LimitSurface surface(wallPlane());
  const relief::Relief relief = wallRelief();
  for (const double azimuth : {0.0, 25.0, -40.0}) {
    const double far = (60.25 - 31.5) / std::cos(radians(azimuth));
    const double top = std::atan(6 / far) * 180 / pi;
    for (const double elevation : {top - 0.5, top + 0.5}) {
      const CrossSection section =
          sectionAt(surface, relief, {60.25, 16}, lightToward(180 + azimuth, elevation));
      EXPECT_NEAR(section.curvature, 0, 1e-12);
      EXPECT_NEAR(section.worldPerTexel, 1, 1e-6);
      EXPECT_NEAR(section.horizon.slope, 6 / far, 1e-6);
      EXPECT_NEAR(section.horizon.distance, far, 1e-4);
      EXPECT_NEAR(CrossSection::angle(section.here.flat.slope), radians(top), 1e-6);
      for (const SectionHorizon& horizon : {section.here.flat, section.here.smallAngle,
                                            section.here.unreduced, section.here.exact}) {
        EXPECT_NEAR(horizon.slope, 6 / far, 1e-6);
        EXPECT_EQ(horizon.shadowed, elevation < top);
      }
      EXPECT_FALSE(section.here.bare.shadowed);
      EXPECT_EQ(section.here.onoue2003, elevation < top);
      EXPECT_EQ(section.here.onoue2004, elevation < top);
      EXPECT_EQ(section.here.onoueExact, elevation < top);
      EXPECT_FALSE(section.fromTables);
      // Bent onto no circle, the profile is itself.
      ASSERT_EQ(section.bentRelief.size(), section.profile.points.size());
      for (std::size_t k = 0; k < section.bentRelief.size(); ++k) {
        const horizon::ProfilePoint& point = section.profile.points[k];
        EXPECT_NEAR(section.bentRelief[k].x, point.distance, 1e-4);
        EXPECT_NEAR(section.bentRelief[k].y, point.height, 1e-6);
      }
      EXPECT_NEAR(section.horizonPoint.x, far, 1e-4);
      EXPECT_NEAR(section.horizonPoint.y, 6, 1e-6);
      EXPECT_NEAR(section.lightDirection.y / section.lightDirection.x, std::tan(radians(elevation)),
                  1e-6);
    }
  }
}

/// The wall under a light with a disc, whose lowest and highest rays lie ρ from its centre.
TEST(CrossSection, ShowsOfADiscTheShareOverTheWall) {
  const surface::LimitSurface surface(wallPlane());
  const relief::Relief relief = wallRelief();
  const double top = std::atan(6 / (60.25 - 31.5));
  const double radius = radians(3.0);
  double last = -1;
  for (const double over : {-4.0, -3.0, -1.7, 0.0, 0.4, 2.9, 3.5}) {
    const double elevation = top + radians(over);
    const CrossSection section =
        crossSection(surface, relief, sampleAt(surface, relief, {60.25, 16}),
                     lightToward(180, elevation * 180 / pi), {128, 8, radius})
            .value();
    const double expected = test::flatShare(elevation, top, radius);
    EXPECT_NEAR(section.here.flat.share, expected, 1e-5);
    EXPECT_NEAR(section.here.onoue2004Share, expected, 1e-5);
    EXPECT_NEAR(section.here.onoueExactShare, expected, 1e-5);
    EXPECT_GE(section.here.flat.share, last);
    last = section.here.flat.share;
    for (const auto& [ray, angle] : {std::pair(section.lowestRay, elevation - radius),
                                     {section.lightDirection, elevation},
                                     {section.highestRay, elevation + radius}}) {
      EXPECT_NEAR(std::atan2(ray.y, ray.x), angle, 1e-6);
      EXPECT_NEAR(glm::length(ray), 1, 1e-12);
    }
    // Of a point the share is 0 or 1.
    const CrossSection point =
        sectionAt(surface, relief, {60.25, 16}, lightToward(180, elevation * 180 / pi));
    EXPECT_EQ(point.here.flat.share, point.here.flat.shadowed ? 0 : 1);
    EXPECT_LT(glm::distance(point.lowestRay, point.lightDirection), 1e-12);
  }
  EXPECT_EQ(last, 1);
}

/// Heights in texels: a = σ on an even map, so that slopes in the world are those of the map.
TEST(CrossSection, MeasuresHeightsInTexelsWhereTheReliefDoes) {
  const surface::LimitSurface surface(surface::makePlane(48, 16, 12, 4));
  relief::Relief relief = wallRelief();
  relief.space = relief::HeightSpace::texture;
  const CrossSection section = sectionAt(surface, relief, {60, 16}, lightToward(180, 20));
  EXPECT_NEAR(section.worldPerTexel, 0.5, 1e-6);
  EXPECT_NEAR(section.worldPerHeight, 0.5, 1e-6);
  EXPECT_NEAR(section.here.flat.slope, 6 / 28.5, 1e-6);
  EXPECT_NEAR(section.here.lookups.arcLength, 28.5 / 2, 1e-4);
  EXPECT_NEAR(section.bentRelief.back().x, 64, 1e-3);  // 128 texels
}

/// Figure 2 on a sphere, where the osculating circle is the section itself.
TEST(CrossSection, OnASphereLiesOnTheSphere) {
  constexpr double radius = 80;
  const surface::LimitSurface surface(surface::makeSphere(radius, 1, 1, 32, 32));
  const relief::Relief relief = randomRelief(64, 64, 4, 3);
  for (const Vec3& light : {lightToward(20, 35), lightToward(140, 60), lightToward(290, 20)}) {
    const CrossSection section = sectionAt(surface, relief, {33.3, 35.8}, light);
    EXPECT_NEAR(section.curvature, 1 / radius, 1e-3 / radius);
    EXPECT_NEAR(glm::length(section.along), 1, 1e-9);
    EXPECT_NEAR(glm::dot(section.along, section.up), 0, 1e-9);
    // The plane holds the light.
    const Vec3 across = glm::cross(section.along, section.up);
    EXPECT_NEAR(glm::dot(across, light), 0, 1e-9);
    EXPECT_GT(glm::dot(section.along, light), 0);
    ASSERT_GT(section.bentGround.size(), 20U);
    ASSERT_EQ(section.bentGround.size(), section.bentRelief.size());
    for (std::size_t k = 0; k < section.bentGround.size(); ++k) {
      const auto inWorld = [&](Vec2 place) {
        return section.origin + place.x * section.along + place.y * section.up;
      };
      const Vec3 ground = inWorld(section.bentGround[k]);
      EXPECT_NEAR(glm::length(ground), radius, 1e-3 * radius);
      EXPECT_NEAR(glm::distance(section.inPlane(ground), section.bentGround[k]), 0, 1e-9);
      // Upright over the ground, by the height.
      const Vec3 rise = inWorld(section.bentRelief[k]) - ground;
      EXPECT_NEAR(glm::length(rise), section.profile.points[k].height, 1e-9);
      EXPECT_LT(glm::length(glm::cross(rise, ground)), 1e-2 * radius);
    }
    // The exact formula is the slope of the line from the eye to the horizon point drawn.
    const Vec2 sight = section.horizonPoint - section.eye;
    if (section.horizon.distance > 0) {
      EXPECT_NEAR(section.here.exact.slope, sight.y / sight.x, 1e-9);
    }
  }
}

/// Figure 3: from the tip of a pin the bare sphere's horizon dips by arccos(R / (R + h)).
TEST(CrossSection, FromAPinSeesTheBareSpheresHorizon) {
  constexpr double radius = 60;
  constexpr double height = 5;
  const surface::LimitSurface surface(surface::makeSphere(radius, 1.35, 1.35, 81, 81));
  const relief::Relief relief =
      stepRelief(81, 81, height, [](int i, int j) { return i == 40 && j == 40; });
  const double dip = std::acos(radius / (radius + height)) * 180 / pi;
  for (const double offset : {-0.05, 0.05}) {
    const CrossSection section =
        sectionAt(surface, relief, {40.5, 40.5}, lightToward(33, -dip + offset));
    EXPECT_NEAR(CrossSection::angle(section.here.bare.slope), radians(-dip), 1e-3);
    EXPECT_EQ(section.here.onoue2003, offset < 0);
    EXPECT_EQ(section.here.onoue2004, offset < 0);
    EXPECT_EQ(section.here.onoueExact, offset < 0);
    EXPECT_NEAR(section.eye.y, height, 1e-6);
  }
}

TEST(CrossSection, WhereTheSurfaceIsConcaveIsBentUpward) {
  // The inside of a torus' hole is saddle-shaped: concave along one direction.
  const surface::LimitSurface surface(surface::makeTorus(30, 10, 96, 66));
  const relief::Relief relief = flatRelief(96, 66);
  const surface::SurfaceSample inner = sampleAt(surface, relief, {48, 0.5});
  const auto section = crossSection(surface, relief, inner, lightToward(0, 20)).value();
  ASSERT_LT(section.curvature, 0);
  EXPECT_GT(section.bentGround.back().y, 0);
  EXPECT_EQ(section.here.bare.slope, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(section.here.onoue2003, section.here.flat.shadowed);
}

TEST(CrossSection, IsAbsentWithoutASampleAndFiniteUnderAZenithLight) {
  const surface::LimitSurface surface(wallPlane());
  const relief::Relief relief = wallRelief();
  EXPECT_FALSE(crossSection(surface, relief, {}, Vec3(0, 0, 1)));
  const CrossSection section = sectionAt(surface, relief, {60, 16}, Vec3(0, 0, 1));
  EXPECT_FALSE(section.here.onoue2004);
  EXPECT_NEAR(section.lightDirection.y, 1, 1e-12);
  EXPECT_EQ(section.here.flat.share, 1);
  for (const Vec2& point : section.bentRelief) {
    EXPECT_TRUE(std::isfinite(point.x) && std::isfinite(point.y));
  }
}

TEST(OsculatingCircle, TendsToTheFlatReliefAndKeepsItsRadius) {
  EXPECT_EQ(onOsculatingCircle(0, 7, 2), Vec2(7, 2));
  EXPECT_NEAR(glm::distance(onOsculatingCircle(1e-9, 7, 2), Vec2(7, 2)), 0, 1e-6);
  for (const double curvature : {0.02, -0.05}) {
    for (const double arc : {-9.0, 3.0, 25.0}) {
      const Vec2 centre(0, -1 / curvature);
      EXPECT_NEAR(glm::distance(onOsculatingCircle(curvature, arc, 1.5), centre),
                  std::abs(1 / curvature + 1.5), 1e-9);
    }
  }
}

using LitInSection = std::function<bool(const SectionHorizons&)>;

SectionTables tablesOf(const RenderScene& scene) {
  const horizon::TableShape& shape = scene.tables;
  return {scene.horizon, scene.distance, shape};
}

/// Share of a view's samples where the section and the shader differ.
double differingShare(const RenderScene& scene, const render::RenderView& view,
                      const std::string& method, const LitInSection& verdict) {
  const SectionTables tables = tablesOf(scene);
  const Vec3 light = lightToward(50, 30);
  const surface::SampleGrid samples = scene.samples(view);
  const Mask mask = scene.test(method, view, light);
  EXPECT_GT(shareShadowed(mask), 0.1);
  EXPECT_LT(shareShadowed(mask), 0.9);
  std::size_t differ = 0;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    const auto section = crossSection(scene.surface, scene.relief, samples.samples[i], light,
                                      {scene.tables.radiusTexels, 0}, &tables);
    const bool dark = verdict(section.value().fromTables.value());
    differ += dark != (mask.samples[i] == Shade::shadowed) ? 1 : 0;
  }
  return static_cast<double>(differ) / static_cast<double>(mask.size());
}

bool flat(const SectionHorizons& at) {
  return at.flat.shadowed;
}
bool of2003(const SectionHorizons& at) {
  return at.onoue2003;
}
bool of2004(const SectionHorizons& at) {
  return at.onoue2004;
}
bool exact(const SectionHorizons& at) {
  return at.onoueExact;
}

/// The base mesh is so fine that its frames are the limit surface's but for rounding.
void expectAgreement(const RenderScene& scene, const render::RenderView& view) {
  EXPECT_LT(differingShare(scene, view, "max-forsyth", flat), 1e-3);
  EXPECT_LT(differingShare(scene, view, "onoue-2003", of2003), 1e-3);
  EXPECT_LT(differingShare(scene, view, "onoue-2004", of2004), 1e-3);
  EXPECT_LT(differingShare(scene, view, "onoue-exact", exact), 1e-3);
  // The methods differ here, so that the agreement says something.
  EXPECT_GT(differingShare(scene, view, "onoue-2004", flat), 0.01);
  EXPECT_GT(differingShare(scene, view, "onoue-2004", exact), 0.002);
}

TEST(CrossSection, SaysOfEveryPixelWhatTheShaderAnswers) {
  const render::GlContext gl;
  for (const relief::HeightSpace space :
       {relief::HeightSpace::world, relief::HeightSpace::texture}) {
    relief::Relief relief = randomRelief(64, 32, 2, 21);
    relief.space = space;
    const RenderScene scene(surface::makeTorus(30, 10, 96, 66), relief, {16, 6},
                            horizon::TableBits::sixteen, 6);
    expectAgreement(scene, render::atlasView(scene.surface, 1));
  }
}

/// The mean of |ΔV| between the section and the shader that holds its horizon against the disc.
double meanDifference(const RenderScene& scene, const render::RenderView& view,
                      const std::string& method,
                      const std::function<double(const SectionHorizons&)>& share) {
  const SectionTables tables = tablesOf(scene);
  const Vec3 light = lightToward(50, 30);
  const double radius = radians(8.0);
  const surface::SampleGrid samples = scene.samples(view);
  const Visibility drawn =
      scene
          .shares(render::readMethod(render::methodFile(render::shaderFolder(), method)), view,
                  light, radius, render::SoftAnswer::disc)
          .test;
  Visibility found = drawn;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const auto section = crossSection(scene.surface, scene.relief, samples.samples[i], light,
                                      {scene.tables.radiusTexels, 0, radius}, &tables);
    found.shares[i] = static_cast<float>(share(section.value().fromTables.value()));
  }
  return test::meanDifference(drawn, found);
}

TEST(CrossSection, SeesOfADiscWhatTheShaderAnswers) {
  const render::GlContext gl;
  const RenderScene scene(surface::makeTorus(30, 10, 96, 66), randomRelief(64, 32, 2, 21), {16, 6},
                          horizon::TableBits::sixteen, 6);
  const render::RenderView view = render::atlasView(scene.surface, 1);
  const auto of2004 = [](const SectionHorizons& at) { return at.onoue2004Share; };
  const auto exactly = [](const SectionHorizons& at) { return at.onoueExactShare; };
  EXPECT_LT(
      meanDifference(scene, view, "max-forsyth", [](const auto& at) { return at.flat.share; }),
      1e-3);
  EXPECT_LT(meanDifference(scene, view, "onoue-2004", of2004), 1e-3);
  EXPECT_LT(meanDifference(scene, view, "onoue-exact", exactly), 1e-3);
  EXPECT_GT(meanDifference(scene, view, "max-forsyth", of2004), 0.01);
}

/// z = 0.005 (x² + y²), 96 wide: a surface on which the 2003 paper falls back to the flat horizon.
surface::Cage bowl() {
  const std::array<double, 4> square = {2304, -768, -768, 2304};  // the blossoms of x²
  std::array<Vec3, 16> points{};
  for (std::size_t k = 0; k < points.size(); ++k) {
    points.at(k) = {-48 + 32.0 * static_cast<double>(k % 4),
                    -48 + 32.0 * static_cast<double>(k / 4),
                    0.005 * (square.at(k % 4) + square.at(k / 4))};
  }
  return surface::makeBezier(points, 48, 48);
}

TEST(CrossSection, SaysInABowlWhatTheShaderAnswers) {
  const render::GlContext gl;
  const relief::Relief relief{relief::makeColumns(96, 96, {32, 8, 1}, 8, relief::Wrap::clamp),
                              relief::HeightSpace::world, Vec2(1)};
  const RenderScene scene(bowl(), relief, {16, 24}, horizon::TableBits::sixteen, 4);
  const render::RenderView view = render::atlasView(scene.surface, 1);
  expectAgreement(scene, view);
  EXPECT_GT(differingShare(scene, view, "onoue-2003", of2004), 0.01);
}

}  // namespace
}  // namespace gnomon::app
