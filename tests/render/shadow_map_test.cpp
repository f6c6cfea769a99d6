// The shadow map tends to what rays through the very triangles that it draws find.

#include <gtest/gtest.h>

#include <cmath>

#include "render/displaced_rays.h"
#include "truth/truth_scenes.h"

namespace gnomon::render {
namespace {

using test::cameraAt;
using test::DisplacedScene;
using test::judge;
using test::lightToward;
using test::randomRelief;
using test::Rays;
using test::Verdict;

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

}  // namespace
}  // namespace gnomon::render
