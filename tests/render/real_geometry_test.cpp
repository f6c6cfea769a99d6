// Methods of real geometry, shadow volumes and a shadow map: what needs no shadow, a box's shadow
// by hand, and the truth that they tend to.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "relief/patterns.h"
#include "render/displaced_rays.h"
#include "render/traced_scene.h"

namespace gnomon::render {
namespace {

using test::above;
using test::arch;
using test::cameraAt;
using test::difference;
using test::DisplacedScene;
using test::flatRelief;
using test::lightToward;
using test::shareShadowed;
using test::stepRelief;
using test::TracedScene;

relief::Relief box(double height) {
  return stepRelief(48, 48, height,
                    [](int i, int j) { return i >= 20 && i < 28 && j >= 20 && j < 28; });
}

// ---- nothing to shade

TEST(RealGeometry, UndisplacedPlaneIsLitWhole) {
  const GlContext gl;
  const DisplacedScene scene(surface::makePlane(48, 48, 6, 6), flatRelief(48, 48), 9);
  for (const Camera& camera : {above, cameraAt({10, -70, 30}, {0, 0, 0}, 40, 96)}) {
    const RenderView view = cameraView(camera, scene.displaced.mesh);
    for (const auto& [azimuth, elevation] : {std::pair{20.0, 80.0},
                                             {20.0, 30.0},
                                             {45.0, 10.0},
                                             {90.0, 5.0},
                                             {200.0, 2.0},
                                             {0.0, 90.0}}) {
      const Vec3 light = lightToward(azimuth, elevation);
      EXPECT_EQ(shareShadowed(scene.answer("shadow-volume", view, light)), 0) << elevation;
      EXPECT_EQ(shareShadowed(scene.answer("shadow-map", view, light)), 0) << elevation;
    }
  }
  const RenderView atlas = atlasView(scene.surface, 24);
  for (const double elevation : {80.0, 30.0, 10.0, 2.0}) {
    EXPECT_EQ(shareShadowed(scene.answer("shadow-map", atlas, lightToward(20, elevation))), 0);
  }
}

TEST(RealGeometry, ConvexPatchThatFacesTheLightIsLitWhole) {
  const GlContext gl;
  const DisplacedScene scene(arch(12, 12), flatRelief(48, 48), 5);
  const RenderView view =
      cameraView(cameraAt({20, -60, 60}, {0, 0, 4}, 40, 96), scene.displaced.mesh);
  const RenderView atlas = atlasView(scene.surface, 16);
  for (const double azimuth : {0.0, 77.0, 200.0}) {
    const Vec3 light = lightToward(azimuth, 70);
    EXPECT_EQ(shareShadowed(scene.answer("shadow-volume", view, light)), 0) << azimuth;
    EXPECT_EQ(shareShadowed(scene.answer("shadow-map", view, light)), 0) << azimuth;
    EXPECT_EQ(shareShadowed(scene.answer("shadow-map", atlas, light)), 0) << azimuth;
  }
}

TEST(RealGeometry, PlaneLitFromBelowIsDarkWhole) {
  const GlContext gl;
  const DisplacedScene scene(surface::makePlane(48, 48, 6, 6), flatRelief(48, 48), 3);
  const RenderView view = cameraView(above, scene.displaced.mesh);
  for (const double elevation : {-5.0, -60.0, -90.0}) {
    const Vec3 light = lightToward(20, elevation);
    EXPECT_EQ(shareShadowed(scene.answer("shadow-volume", view, light)), 1);
    EXPECT_EQ(shareShadowed(scene.answer("shadow-map", view, light)), 1);
  }
}

TEST(RealGeometry, ShadowMapWithoutBiasHasAcne) {
  const GlContext gl;
  const DisplacedScene scene(surface::makePlane(48, 48, 6, 6), flatRelief(48, 48), 9);
  const RenderView view = cameraView(above, scene.displaced.mesh);
  const Mask mask = scene.answer("shadow-map", view, lightToward(20, 30), {{"bias", 0}});
  EXPECT_GT(shareShadowed(mask), 0.05);
}

// ---- a box's shadow

/// The last shadowed column of the middle row, as a place x in the world; the camera looks straight
/// down at z = 0.
double shadowEnd(const Mask& mask, const surface::SampleGrid& samples,
                 const surface::LimitSurface& surface) {
  double end = -1000;
  for (int column = 0; column < mask.width; ++column) {
    const auto i = static_cast<std::size_t>(mask.height / 2 * mask.width + column);
    if (mask.samples[i] != Shade::shadowed) continue;
    const surface::SurfaceSample& s = samples.samples[i];
    end = std::max(end, surface.evaluate(s).position.x);
  }
  return end;
}

TEST(RealGeometry, BoxCastsAShadowAsLongAsTheTangentOfTheLightSays) {
  const GlContext gl;
  constexpr double height = 5;
  // Vertices at every half texel, texel centres among them: the mesh is the relief itself.
  const DisplacedScene scene(surface::makePlane(48, 48, 6, 6), box(height), 16);
  const RenderView view =
      cameraView(cameraAt({0, 0, 100}, {0, 0, 0}, 27, 384), scene.displaced.mesh);
  const surface::SampleGrid samples = scene.samples(view);
  const double pixel = 2 * 100 * std::tan(radians(13.5)) / 384;
  const double edge = 27.5 - 24;  // the end of its top
  for (const double elevation : {55.0, 40.0, 25.0, 17.0}) {
    const Vec3 light = lightToward(180, elevation);
    const double expected = edge + height / std::tan(radians(elevation));
    const Mask volumes = scene.answer("shadow-volume", view, light);
    EXPECT_NEAR(shadowEnd(volumes, samples, scene.surface), expected, 1.01 * pixel) << elevation;
    // The map's texel is 0.035 wide; its bias lets light in for about one, its filter for 1.5.
    const Mask map = scene.answer("shadow-map", view, light);
    EXPECT_NEAR(shadowEnd(map, samples, scene.surface), expected, pixel + 0.4) << elevation;
    // Across the light the shadow is as wide as the box's top and its sloped sides can cast.
    EXPECT_LT(shadowEnd(scene.answer("shadow-volume", view, lightToward(0, elevation)), samples,
                        scene.surface),
              28.5 - 24);
  }
}

TEST(RealGeometry, ShadowVolumesOfABoxAreTheTracers) {
  const GlContext gl;
  // At the box's four corners the relief is not flat inside a texel: quarter texels, and halves of
  // them for the tracer.
  const DisplacedScene scene(surface::makePlane(48, 48, 6, 6), box(5), 32);
  const TracedScene traced(scene.surface, scene.relief, 0.125);
  for (const Camera& camera : {above, cameraAt({30, -60, 40}, {0, 0, 2}, 40, 128)}) {
    const RenderView view = cameraView(camera, scene.displaced.mesh);
    const surface::SampleGrid samples = scene.samples(view);
    for (const auto& [azimuth, elevation] :
         {std::pair{20.0, 35.0}, {-140.0, 20.0}, {90.0, 50.0}, {180.0, 10.0}}) {
      const Vec3 light = lightToward(azimuth, elevation);
      const Mask truth = traced.mask(scene.surface, scene.relief, samples, light);
      const Mask mask = scene.answer("shadow-volume", view, light);
      EXPECT_GT(shareShadowed(truth), 0.01);
      // Single pixels on the very edges of shadows.
      EXPECT_LT(difference(mask, truth), 1e-3) << azimuth << " " << elevation;
    }
  }
}

// ---- more polygons, less error: the mesh is all that shadow volumes err by

TEST(RealGeometry, ShadowVolumesTendToTheTruthOfFigure8AsTheMeshIsRefined) {
  const GlContext gl;
  std::array<Vec3, 16> points{};
  const std::array<double, 4> across = {-66, -50, 50, 66};
  const std::array<double, 4> along = {-80, -28, 28, 80};
  for (std::size_t j = 0; j < 4; ++j) {
    for (std::size_t i = 0; i < 4; ++i) {
      const bool rim = i == 0 || i == 3;
      const bool end = j == 0 || j == 3;
      points.at(4 * j + i) = Vec3(across.at(i), along.at(j), (rim ? -48 : 34) + (end ? 0 : 24));
    }
  }
  const relief::Relief relief{relief::makeColumns(192, 160, {32, 7, 3}, 8, relief::Wrap::clamp),
                              relief::HeightSpace::texture, Vec2(1)};
  const surface::Cage cage = surface::makeBezier(points, 24, 20);
  Camera camera = cameraAt({0, -205, 275}, {0, -4, -2}, 32, 384);
  const Vec3 light = lightToward(165, 24);
  std::optional<TracedScene> traced;
  std::vector<double> errors;
  for (const int subdivisions : {9, 18, 36}) {
    const DisplacedScene scene(cage, relief, subdivisions);
    if (!traced) traced.emplace(scene.surface, relief, 0.125);
    const RenderView view = cameraView(camera, scene.displaced.mesh);
    const Mask truth = traced->mask(scene.surface, relief, scene.samples(view), light);
    EXPECT_GT(shareShadowed(truth), 0.2);
    errors.push_back(difference(scene.answer("shadow-volume", view, light), truth));
    RecordProperty("error_at_" + std::to_string(subdivisions), std::to_string(errors.back()));
  }
  // A facet's chord leaves the relief by less than its width: first order.
  EXPECT_LT(errors[0], 0.025);
  EXPECT_GT(errors[0], 0.008);
  EXPECT_LT(errors[1], errors[0] / 1.5);
  EXPECT_LT(errors[2], errors[1] / 1.5);
}

}  // namespace
}  // namespace gnomon::render
