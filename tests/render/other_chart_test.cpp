// Charts of the texture that overlap: a pass over the texture has one of them a texel, and methods
// fall back for the others.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "render/render_scene.h"
#include "truth/truth_scenes.h"

namespace gnomon::render {
namespace {

using test::RenderScene;

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
