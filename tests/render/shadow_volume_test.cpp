// Shadow volumes against rays through the very triangles that they draw, one triangle after
// another.

#include <gtest/gtest.h>

#include <cstddef>

#include "common/error.h"
#include "render/displaced_rays.h"
#include "truth/truth_scenes.h"

namespace gnomon::render {
namespace {

using test::above;
using test::arch;
using test::cameraAt;
using test::DisplacedScene;
using test::flatRelief;
using test::judge;
using test::lightToward;
using test::randomRelief;
using test::Rays;
using test::stepRelief;
using test::Verdict;

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
    expectRaysAnswer(scene, 4, above, lightToward(azimuth, 30), "from above");
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
