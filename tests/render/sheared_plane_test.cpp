// The shaders on planes whose texture is stretched, sheared or mirrored, against the closed form.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "render/render_scene.h"
#include "truth/truth_scenes.h"

namespace gnomon::render {
namespace {

using test::RenderScene;
using test::ShearedPlane;
using test::shearedPlanes;
using test::stepRelief;

constexpr int planeSamples = 24;  ///< of a face: 3 a texel

/// The last shadowed sample of the atlas's row through the middle of the map, as a place x in
/// texels; the wall's lee side is toward greater x.
double shadowsEnd(const Mask& mask, const ShearedPlane& plane) {
  double end = 0;
  for (int face = 0; face < plane.columns; ++face) {
    for (int i = 0; i < planeSamples; ++i) {
      // A cage that is no grid lays its faces out row by row on a square.
      const int tiles = mask.width / planeSamples;
      const int cell = 2 * plane.columns + face;
      const int column = (cell % tiles) * planeSamples + i;
      const int row = mask.height - 1 - ((cell / tiles) * planeSamples + planeSamples / 2);
      const auto index = static_cast<std::size_t>(row * mask.width + column);
      if (mask.samples[index] != Shade::shadowed) continue;
      const double along = (face + (i + 0.5) / planeSamples) / plane.columns * plane.width;
      end = std::max(end, plane.mirrored() ? plane.width - along : along);
    }
  }
  return end + 0.5 * plane.width / (plane.columns * planeSamples);
}

struct Case {
  std::string method;
  double tolerance;  ///< texels, beside the sample's width and what a convex horizon's chord adds
};

/// Marches take steps; Sloan & Cohen's angles come in 256 steps of a right angle.
const std::vector<Case> cases = {
    {"max-forsyth", 0},        {"onoue-2004", 0},        {"onoue-exact", 0},
    {"sloan-cohen", 0.5},      {"resampled-horizon", 0}, {"relief-march", 0.3},
    {"osculating-march", 0.3}, {"geodesic-march", 0.3},  {"surface-march", 0.3}};

class ShearedShadow : public testing::TestWithParam<relief::HeightSpace> {};

/// As the truth's own test: the shadow of a wall 6 height units high ends 6 a |e_x| / (σ tan θ)
/// texels from its top edge at x = 31.5. A shader that forgot the metric would be off by the ratio
/// of the two axes.
TEST_P(ShearedShadow, EndsWhereTheMetricSays) {
  const GlContext gl;
  int shadows = 0;
  for (const ShearedPlane& plane : shearedPlanes()) {
    relief::Relief relief =
        stepRelief(plane.width, plane.height, 6, [](int i, int) { return i >= 28 && i < 32; });
    relief.space = GetParam();
    const RenderScene scene(plane.cage(), relief, {24, 60}, horizon::TableBits::thirtyTwo);
    const RenderScene eight(plane.cage(), relief, {8, 60}, horizon::TableBits::thirtyTwo);
    const RenderView view = atlasView(scene.surface, planeSamples);
    for (const double azimuth : {180.0, 150.0, 225.0}) {
      const double a = radians(azimuth);  // one of the tables' 24, two of them of Sloan & Cohen's 8
      const double e = radians(35);
      const double length = 6 * plane.worldPerHeight(relief.space) * std::abs(std::cos(a)) /
                            (plane.worldPerTexel(a) * std::tan(e));
      if (length < 2 || length > 28) continue;
      ++shadows;
      for (const auto& [method, tolerance] : cases) {
        const bool angles = method == "sloan-cohen";
        if (angles && azimuth == 150) continue;
        const Mask mask = (angles ? eight : scene).test(method, view, plane.lightOver(a, e));
        EXPECT_NEAR(shadowsEnd(mask, plane), 31.5 + length, 1.0 / 3 + 1 / (4 * length) + tolerance)
            << method << " at " << azimuth << " on a texel (" << plane.px.x << ", " << plane.px.y
            << ") × (" << plane.py.x << ", " << plane.py.y << ")";
      }
    }
  }
  EXPECT_GE(shadows, 10);
}

INSTANTIATE_TEST_SUITE_P(HeightSpaces, ShearedShadow,
                         testing::Values(relief::HeightSpace::world, relief::HeightSpace::texture));

}  // namespace
}  // namespace gnomon::render
