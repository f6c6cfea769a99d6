#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/error.h"
#include "relief/patterns.h"
#include "render/displaced_rays.h"
#include "render/traced_scene.h"
#include "truth/truth_scenes.h"

// Methods of real geometry, shadow volumes and a shadow map: what needs no shadow, a box's shadow
// by hand, and the truth that they tend to.
// The shadow map tends to what rays through the very triangles that it draws find.
// Shadow volumes against rays through the very triangles that they draw, one triangle after
// another.

namespace gnomon::render {
namespace {

using test::arch;
using test::cameraAt;
using test::difference;
using test::DisplacedScene;
using test::flatRelief;
using test::fromAbove;
using test::judge;
using test::lightToward;
using test::randomRelief;
using test::Rays;
using test::shareShadowed;
using test::stepRelief;
using test::TracedScene;
using test::Verdict;

relief::Relief box(double height) {
  return stepRelief(48, 48, height,
                    [](int i, int j) { return i >= 20 && i < 28 && j >= 20 && j < 28; });
}

// ---- nothing to shade

TEST(RealGeometry, UndisplacedPlaneIsLitWhole) {
  const GlContext gl;
  const DisplacedScene scene(surface::makePlane(48, 48, 6, 6), flatRelief(48, 48), 9);
  for (const Camera& camera : {fromAbove, cameraAt({10, -70, 30}, {0, 0, 0}, 40, 96)}) {
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
  const RenderView view = cameraView(fromAbove, scene.displaced.mesh);
  for (const double elevation : {-5.0, -60.0, -90.0}) {
    const Vec3 light = lightToward(20, elevation);
    EXPECT_EQ(shareShadowed(scene.answer("shadow-volume", view, light)), 1);
    EXPECT_EQ(shareShadowed(scene.answer("shadow-map", view, light)), 1);
  }
}

TEST(RealGeometry, ShadowMapWithoutBiasHasAcne) {
  const GlContext gl;
  const DisplacedScene scene(surface::makePlane(48, 48, 6, 6), flatRelief(48, 48), 9);
  const RenderView view = cameraView(fromAbove, scene.displaced.mesh);
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
  for (const Camera& camera : {fromAbove, cameraAt({30, -60, 40}, {0, 0, 2}, 40, 128)}) {
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

TEST(ShadowMap, TendsToTheRaysAsItsTexelsShrink) {
  const GlContext gl;
  const DisplacedScene scene(surface::makePlane(48, 48, 6, 6), randomRelief(24, 24, 5, 3), 4);
  const Rays rays(scene, 4);
  const Vec3 light = lightToward(20, 30);
  for (const RenderView& view :
       {cameraView(cameraAt({0, 0, 100}, {0, 0, 0}, 30, 256), scene.displaced.mesh),
        atlasView(scene.surface, 40)}) {
    const surface::SampleGrid samples = scene.samples(view);
    // The bias grows with a facet's slope to the light up to 16 and no more: steeper ones,
    // within 3.6° of edge-on, shade themselves in specks however fine the map.
    const Mask truth = rays.mask(samples, light, 1 / std::hypot(1.0, 16.0));
    double before = 1;
    for (const double side : {256.0, 1024.0, 4096.0}) {
      const Verdict verdict =
          judge(scene.answer("shadow-map", view, light, {{"depth_side", side}}), truth, samples);
      const double error =
          static_cast<double>(verdict.wrong) / static_cast<double>(verdict.lit + verdict.dark);
      // Its error is some texels' width along the shadows' edges, four times less each; less falls
      // while texels are as wide as the shadows.
      EXPECT_LT(error, before / 2) << side;
      before = error;
    }
    EXPECT_LT(before, 0.002);
  }
}

TEST(ShadowMap, SeesClosedSurfacesAsRaysDo) {
  const GlContext gl;
  const DisplacedScene torus(surface::makeTorus(30, 10, 58, 58), randomRelief(48, 32, 3, 3), 1);
  const RenderView view =
      cameraView(cameraAt({20, 90, 90}, {0, 0, 0}, 45, 64), torus.displaced.mesh);
  const surface::SampleGrid samples = torus.samples(view);
  for (const Vec3& light : {lightToward(20, 40), lightToward(120, -30)}) {
    const Verdict verdict = judge(torus.answer("shadow-map", view, light),
                                  Rays(torus, 1).mask(samples, light), samples);
    EXPECT_GT(verdict.lit, 200U);
    EXPECT_GT(verdict.dark, 200U);
    EXPECT_LT(verdict.wrong, (verdict.lit + verdict.dark) / 50);
  }
}

/// Shadow volumes are exact: not one pixel may differ where rounding does not decide.
void expectRaysAnswer(const DisplacedScene& scene, int subdivisions, const Camera& camera,
                      const Vec3& light, const char* what, bool both = true) {
  SCOPED_TRACE(what);
  const RenderView view = cameraView(camera, scene.displaced.mesh);
  const surface::SampleGrid samples = scene.samples(view);
  const Mask rays = Rays(scene, subdivisions).mask(samples, light);
  const Mask mask = scene.answer("shadow-volume", view, light);
  const Verdict verdict = judge(mask, rays, samples);
  EXPECT_EQ(verdict.wrong, 0U);
  const std::size_t all = verdict.lit + verdict.dark + verdict.unsure;
  EXPECT_GT(all, mask.size() / 10);
  EXPECT_LT(verdict.unsure, all / 3);
  if (both) {
    EXPECT_GT(verdict.lit, all / 50);
    EXPECT_GT(verdict.dark, all / 50);
  }
}

TEST(ShadowVolumes, AreExactOnARoughPlane) {
  const GlContext gl;
  const DisplacedScene scene(surface::makePlane(48, 48, 6, 6), randomRelief(24, 24, 5, 3), 4);
  for (const double azimuth : {20.0, 111.0, 250.0}) {
    expectRaysAnswer(scene, 4, fromAbove, lightToward(azimuth, 30), "from above");
    expectRaysAnswer(scene, 4, cameraAt({60, -50, 35}, {0, 0, 0}, 45, 96), lightToward(azimuth, 20),
                     "from aside");
  }
}

TEST(ShadowVolumes, AreExactOnClosedSurfaces) {
  const GlContext gl;
  const DisplacedScene torus(surface::makeTorus(30, 10, 58, 58), randomRelief(48, 32, 3, 3), 1);
  expectRaysAnswer(torus, 1, cameraAt({20, 90, 90}, {0, 0, 0}, 45, 64), lightToward(20, 40),
                   "torus");
  expectRaysAnswer(torus, 1, cameraAt({100, 20, 30}, {0, 0, 0}, 45, 64), lightToward(120, -30),
                   "torus, half behind");
  const DisplacedScene cube(test::cubeCage(), randomRelief(8, 8, 1, 3), 8);
  expectRaysAnswer(cube, 8, cameraAt({20, -25, 22}, {0, 0, 0}, 32, 96), lightToward(-10, 30),
                   "cube with seams");
}

TEST(ShadowVolumes, AreExactOnAnOpenPatchWhateverSideTheLightIsOn) {
  const GlContext gl;
  const DisplacedScene scene(arch(8, 8), randomRelief(32, 32, 4, 3), 4);
  const Camera camera = cameraAt({10, -70, 60}, {0, 0, 5}, 45, 96);
  expectRaysAnswer(scene, 4, camera, lightToward(20, 25), "from above");
  expectRaysAnswer(scene, 4, camera, lightToward(200, 4), "grazing");
  // From below light comes in past the rim only where a bump overhangs it.
  expectRaysAnswer(scene, 4, camera, lightToward(20, -35), "from below", false);
  // The far side of a thin sheet, seen from the light's own side: nothing of it faces the camera.
  const DisplacedScene bowl(arch(8, 8), stepRelief(32, 32, -6, [](int i, int) { return i > 15; }),
                            4);
  expectRaysAnswer(bowl, 4, camera, lightToward(160, 20), "one half pressed in");
}

TEST(ShadowVolumes, AreExactForACameraInsideAShadow) {
  const GlContext gl;
  // A tower 30 high whose shadow, at 20°, is 82 long and holds the camera.
  const DisplacedScene scene(
      surface::makePlane(96, 48, 12, 6),
      stepRelief(48, 24, 30, [](int i, int j) { return i >= 10 && i < 16 && j >= 8 && j < 16; }),
      4);
  const Vec3 light = lightToward(180, 20);
  const Vec3 inside(0, 0, 4);
  ASSERT_LT(inside.x + 16, 30 / std::tan(radians(20)));
  expectRaysAnswer(scene, 4, cameraAt(inside, {40, 6, 0}, 100, 96), light, "away from the light");
  expectRaysAnswer(scene, 4, cameraAt(inside, {-4, 24, 0}, 100, 96), light, "across");
  expectRaysAnswer(scene, 4, cameraAt(inside, {-15, 10, 6}, 100, 96), light, "toward the tower",
                   true);
  // Looking along the light and against it: the point at infinity is in the picture's middle.
  expectRaysAnswer(scene, 4, cameraAt({-20, 0, 45}, Vec3(-20, 0, 45) - 10.0 * light, 100, 96),
                   light, "along the light");
}

TEST(ShadowVolumes, LeaveNoStreaksWhereFacetsStandEdgeOnToTheLight) {
  const GlContext gl;
  // The lee side of the box falls from 6 to 0 over one texel: light along it, to the bit of a float
  // and beside it.
  const relief::Relief relief =
      stepRelief(24, 24, 6, [](int i, int j) { return i >= 10 && i < 14 && j >= 10 && j < 14; });
  const DisplacedScene scene(surface::makePlane(24, 24, 3, 3), relief, 16);
  const Camera camera = cameraAt({3, -2, 60}, {0, 0, 0}, 24, 128);
  for (const Vec3& light :
       {glm::normalize(Vec3(-1, 0, 6)), glm::normalize(Vec3(1, 0, 6)),
        glm::normalize(Vec3(0, -1, 6)), glm::normalize(Vec3(-1, -1, 6)),
        glm::normalize(Vec3(-1, 1e-7, 6)), Vec3(0, 0, 1), glm::normalize(Vec3(-1, -1, 3))}) {
    expectRaysAnswer(scene, 16, camera, light, "edge-on", false);
  }
  // A roof with a ridge along y, its far slope exactly along the light.
  const DisplacedScene ridge(surface::makePlane(24, 24, 3, 3),
                             stepRelief(24, 24, 4, [](int i, int) { return i == 11; }), 16);
  for (const double along : {0.0, 1.0, -2.0}) {
    expectRaysAnswer(ridge, 16, camera, glm::normalize(Vec3(-1, along, 4)), "ridge", false);
  }
}

TEST(ShadowVolumes, StayClosedWhereRoundingDecidesHowAFacetFaces) {
  const GlContext gl;
  const DisplacedScene scene(arch(4, 4), randomRelief(16, 16, 3, 3), 2);
  const RenderView view =
      cameraView(cameraAt({10, -50, 60}, {0, 0, 5}, 50, 64), scene.displaced.mesh);
  const surface::SampleGrid samples = scene.samples(view);
  const Rays rays(scene, 2);
  const surface::BaseMesh& mesh = scene.displaced.mesh;
  std::size_t judged = 0;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    // A light in the very plane of a facet. Its two neighbours and itself must agree on whether it
    // faces the light, or a volume without a wall would run through the picture.
    const auto corner = [&](std::size_t k) {
      return mesh.vertices[mesh.triangles[3 * t + k]].frame.position;
    };
    Vec3 light = corner(1) - corner(0) + 0.3 * (corner(2) - corner(0));
    light = glm::normalize(light.z < 0 ? -light : light);
    const Verdict verdict =
        judge(scene.answer("shadow-volume", view, light), rays.mask(samples, light), samples);
    EXPECT_EQ(verdict.wrong, 0U) << t;
    judged += verdict.lit;
  }
  EXPECT_GT(judged, 10000U);
}

TEST(ShadowVolumes, AreCountedForOneCameraOnly) {
  const GlContext gl;
  const DisplacedScene scene(surface::makePlane(24, 24, 3, 3), flatRelief(24, 24), 2);
  EXPECT_THROW((void)scene.answer("shadow-volume", atlasView(scene.surface, 8), {0, 0, 1}),
               InternalError);
}

}  // namespace
}  // namespace gnomon::render
