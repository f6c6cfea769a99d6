#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "relief/patterns.h"
#include "render/open_bowl.h"
#include "render/render_scene.h"
#include "truth/truth_scenes.h"

// The shaders on planes whose texture is stretched, sheared or mirrored, against the closed form.
// The march over maps of the surface: what the other marches cannot know of it.
// Where an open patch ends, for methods that march and for those with tables.
// Charts of the texture that overlap: a pass over the texture has one of them a texel, and methods
// fall back for the others.

namespace gnomon::render {
namespace {

using test::difference;
using test::flatRelief;
using test::lightToward;
using test::openBowl;
using test::RenderScene;
using test::shareShadowed;
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

/// A mask of an atlas that closes at its sides, moved `columns` samples to the right.
Mask turnedBy(const Mask& mask, int columns) {
  Mask turned = mask;
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x) {
      const int from = (x + mask.width - columns) % mask.width;
      turned.samples[static_cast<std::size_t>(y * mask.width + x)] =
          mask.samples[static_cast<std::size_t>(y * mask.width + from)];
    }
  }
  return turned;
}

/// Four columns stand around a torus: a light a quarter turn further casts the same shadows, a
/// quarter further. Some of either cross the map's border, where the torus closes.
TEST(SurfaceMarch, GoesOnWhereAMapCloses) {
  const GlContext gl;
  const relief::Relief columns{relief::makeColumns(96, 48, {24, 10, 1}, 4, relief::Wrap::repeat),
                               relief::HeightSpace::world, Vec2(1)};
  const RenderScene scene(surface::makeTorus(40, 10, 60, 60), columns, {4, 96},
                          horizon::TableBits::eight, 4);
  const RenderView view = atlasView(scene.surface, 4);
  const auto from = [&](double longitude) {
    const Vec3 light(std::sin(longitude), 0.2, std::cos(longitude));
    return scene.answer("surface-march", view, glm::normalize(light));
  };
  const Mask first = from(2.0);
  const Mask second = from(2.0 + pi / 2);
  EXPECT_GT(shareShadowed(first), 0.2);
  EXPECT_LT(difference(turnedBy(first, view.width / 4), second), 1e-3);
  EXPECT_GT(difference(first, second), 0.1) << "a control: not the same without the turn";
}

/// The slope of the bowl is at most 0.32 √2, that is 24.4°: a light at 30° reaches all of it. The
/// circle that the bowl follows at its middle goes on and rises over that.
TEST(ReliefBorder, NothingStandsBeyondABorderForAnyMarch) {
  const GlContext gl;
  const relief::Relief endless = flatRelief(64, 64);
  relief::Relief ended = endless;
  ended.field = endless.field.withBorder({true, true});
  const RenderScene open(openBowl(), ended, {4, 128}, horizon::TableBits::eight, 4);
  const RenderScene on(openBowl(), endless, {4, 128}, horizon::TableBits::eight, 4);
  const RenderView view = atlasView(open.surface, 8);
  const Vec3 light = lightToward(20, 30);
  for (const char* method :
       {"geodesic-march", "resampled-horizon", "osculating-march", "surface-march"}) {
    EXPECT_EQ(shareShadowed(open.answer(method, view, light)), 0) << method;
  }
  EXPECT_GT(shareShadowed(on.answer("geodesic-march", view, light)), 0.1);
  EXPECT_GT(shareShadowed(on.answer("osculating-march", view, light)), 0.1);
}

/// A ray at the slope s from x toward the bowl's border at x = 32 passes it where (32 + x) / 200 <
/// s. Half a texel more of the surface would hide half a texel more.
TEST(ReliefBorder, MarchesEndAtTheBorderItself) {
  const GlContext gl;
  relief::Relief flat = flatRelief(64, 64);
  flat.field = flat.field.withBorder({true, true});
  const RenderScene scene(openBowl(), flat, {4, 128}, horizon::TableBits::eight, 4);
  const RenderView view = atlasView(scene.surface, 8);
  const surface::SampleGrid grid = scene.samples(view);
  const auto endingAt = [&](double end) {
    Mask exact{view.width, view.height, std::vector<Shade>(grid.samples.size(), Shade::none)};
    for (std::size_t i = 0; i < exact.size(); ++i) {
      const double x = scene.surface.tangentPoint(grid.samples[i]).position.x;
      exact.samples[i] = (end + x) / 200 < 0.25 ? Shade::lit : Shade::shadowed;
    }
    return exact;
  };
  const Vec3 light = glm::normalize(Vec3(1, 0, 0.25));
  for (const char* method : {"surface-march", "geodesic-march", "resampled-horizon"}) {
    const Mask answer = scene.answer(method, view, light);
    EXPECT_LT(difference(answer, endingAt(32)), 1e-3) << method;
    EXPECT_GT(difference(answer, endingAt(32.5)), 5e-3) << method;
  }
}

/// A wall on the far side of a repeating map's border, where the next tile would have it.
TEST(ReliefBorder, TheNextTileOfAnOpenPatchCastsNoShadow) {
  const GlContext gl;
  const relief::Relief tiled = stepRelief(
      64, 64, 8, [](int i, int) { return i >= 4 && i < 8; }, relief::Wrap::repeat);
  relief::Relief ended = tiled;
  ended.field = tiled.field.withBorder({true, true});
  const RenderScene tiles(surface::makePlane(64, 64, 8, 8), tiled, {4, 40},
                          horizon::TableBits::thirtyTwo);
  const RenderScene patch(surface::makePlane(64, 64, 8, 8), ended, {4, 40},
                          horizon::TableBits::thirtyTwo);
  const RenderView view = atlasView(tiles.surface, 9);
  // Toward +x the wall is behind all that lies more than 8 texels from it.
  const surface::SampleGrid grid = tiles.samples(view);
  const auto shadowedPastTheWall = [&](const RenderScene& scene, const char* method) {
    const Mask mask = scene.answer(method, view, lightToward(0, 30));
    std::size_t dark = 0;
    for (std::size_t i = 0; i < mask.size(); ++i) {
      const surface::SurfaceSample& at = grid.samples[i];
      const double x = scene.surface.tangentPoint(at).position.x;
      dark += x > -20 && mask.samples[i] == Shade::shadowed ? 1 : 0;
    }
    return dark;
  };
  for (const char* method :
       {"max-forsyth", "sloan-cohen", "ellipse", "onoue-2004", "onoue-exact", "resampled-horizon",
        "relief-march", "osculating-march", "geodesic-march"}) {
    EXPECT_EQ(shadowedPastTheWall(patch, method), 0U) << method;
    EXPECT_GT(shadowedPastTheWall(tiles, method), 100U) << method;
  }
  // It has seen the surface.
  EXPECT_EQ(shadowedPastTheWall(tiles, "surface-march"), 0U);
  EXPECT_EQ(shadowedPastTheWall(patch, "surface-march"), 0U);
}

/// A plane of 48 texels, and where there are two a second one beside it, turned by a quarter about
/// its normal, with the same texture coordinates.
surface::Cage planes(int count) {
  surface::Cage cage = surface::makePlane(48, 48, 6, 6);
  if (count == 1) return cage;
  const surface::Cage first = cage;
  const int offset = static_cast<int>(first.positions.size());
  for (const Vec3& at : first.positions) cage.positions.emplace_back(60 - at.y, at.x, at.z);
  for (const int vertex : first.faceVertices) cage.faceVertices.push_back(vertex + offset);
  cage.faceUvs.insert(cage.faceUvs.end(), first.faceUvs.begin(), first.faceUvs.end());
  cage.grid = std::nullopt;
  return cage;
}

/// A ridge of height 4 over x = 20.5 texels. The light comes over the first plane's from low x at
/// tan θ = 1/3, and along the second one's, which casts no shadow.
struct Ridges {
  explicit Ridges(int count)
      : scene(planes(count), heights(), {8, 48}, horizon::TableBits::thirtyTwo, 4),
        view(atlasView(scene.surface, 20)) {}

  static relief::Relief heights() {
    std::vector<float> texels(48 * 48, 0);
    for (std::size_t j = 0; j < 48; ++j) texels[48 * j + 20] = 4;
    return {relief::HeightField(48, 48, std::move(texels), relief::Wrap::clamp),
            relief::HeightSpace::world, Vec2(1)};
  }

  [[nodiscard]] MethodAnswers answers(const std::string& method) const {
    return scene.answers(readMethod(methodFile(shaderFolder(), method)), view, {light}).front();
  }

  /// Of a plane, the share of the samples whose answer is wrong, without those near an edge.
  [[nodiscard]] double wrong(const Mask& mask, int plane) const {
    const surface::SampleGrid samples = scene.samples(view);
    std::size_t all = 0;
    std::size_t differ = 0;
    for (std::size_t i = 0; i < mask.size(); ++i) {
      const surface::SurfaceSample& sample = samples.samples[i];
      if (!sample.isOnSurface() || sample.face / 36 != plane) continue;
      const double behind = 48 * scene.surface.tangentPoint(sample).uv.x - 20.5;
      if (std::abs(behind) < 1 || std::abs(behind - 12) < 1) continue;
      const bool isDark = plane == 0 && behind > 0 && behind < 12;
      ++all;
      differ += isDark == (mask.samples[i] == Shade::shadowed) ? 0 : 1;
    }
    return static_cast<double>(differ) / static_cast<double>(all);
  }

  RenderScene scene;
  RenderView view;
  Vec3 light = glm::normalize(Vec3(-3, 0, 1));
};

TEST(OtherChart, MethodsFallBackForTheChartThatLostTheTexels) {
  const GlContext gl;
  const Ridges two(2);
  for (const char* method :
       {"two-scales-surface", "surface-march", "sloan-cohen", "shadow-heights"}) {
    const MethodAnswers answers = two.answers(method);
    EXPECT_EQ(answers.otherChartShare, 0.5) << method << ": all samples of the second plane";
    EXPECT_LT(two.wrong(answers.drawn, 0), 0.01) << method;
    EXPECT_LT(two.wrong(answers.drawn, 1), 0.01) << method;
  }
}

TEST(OtherChart, AChartAloneMeetsNone) {
  const GlContext gl;
  const Ridges one(1);
  const Ridges two(2);
  for (const char* method : {"two-scales-surface", "surface-march", "sloan-cohen"}) {
    const MethodAnswers answers = one.answers(method);
    EXPECT_EQ(answers.otherChartShare, 0) << method;
    EXPECT_LT(one.wrong(answers.drawn, 0), 0.01) << method;
  }
  EXPECT_EQ(two.answers("geodesic-march").otherChartShare, 0) << "it has no maps of the surface";
}

TEST(OtherChart, UnderADiscTheyFallBackToo) {
  const GlContext gl;
  const Ridges two(2);
  for (const char* method : {"two-scales-surface", "surface-march", "shadow-heights"}) {
    const VisibilityAnswers found =
        two.scene.shares(readMethod(methodFile(shaderFolder(), method)), two.view, two.light, 0.02);
    EXPECT_EQ(found.otherChartShare, 0.5) << method;
    Mask cut = cutInHalf(found.test);
    EXPECT_LT(two.wrong(cut, 0), 0.01) << method;
    EXPECT_LT(two.wrong(cut, 1), 0.01) << method;
  }
}

}  // namespace
}  // namespace gnomon::render
