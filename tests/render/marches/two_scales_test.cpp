// The mesh that a method's light alone sees, and the method that lives on it.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "common/error.h"
#include "render/displaced_rays.h"
#include "render/method_text.h"
#include "truth/truth_scenes.h"

namespace gnomon::render {
namespace {

using test::cameraAt;
using test::difference;
using test::DisplacedScene;
using test::judge;
using test::lightToward;
using test::randomRelief;
using test::Rays;
using test::RenderScene;
using test::shareShadowed;

relief::Relief worldRelief(int width, int height, std::vector<float> texels) {
  return {relief::HeightField(width, height, std::move(texels), relief::Wrap::clamp),
          relief::HeightSpace::world, Vec2(1)};
}

/// A method that says shadowed where the light sees something else than P + `height` n.
Method depthProbe(const std::string& lines, double height) {
  return test::methodOfText("passes = [\"light-depth\"]\n" + lines +
                                "[parameters.depth_side]\ndefault = 64\nminimum = 1\nmaximum = 64\n"
                                "[parameters.light_pieces]\ndefault = 2\nminimum = 1\nmaximum = 64",
                            "bool isShadowed(Pixel pixel, LocalLight light) {\n"
                            "  vec3 place = lightMapPlace(pixel.position + " +
                                std::to_string(height) +
                                " * pixel.normal);\n"
                                "  float off = place.z - lightDepthOf(ivec2(floor(place.xy)));\n"
                                "  return abs(off) * lightMapLengths.y > 0.01;\n}\n");
}

TEST(LightMesh, IsWhatTheLightSees) {
  const GlContext gl;
  const RenderScene scene(surface::makePlane(16, 16, 4, 4),
                          worldRelief(16, 16, std::vector<float>(256, 3)), {4, 4},
                          horizon::TableBits::thirtyTwo);
  const RenderView view = atlasView(scene.surface, 16);
  const auto share = [&](const std::string& lines, double height) {
    return shareShadowed(scene.answer(depthProbe(lines, height), view, {0, 0, 1}));
  };
  const std::string displaced = "light_mesh = \"displaced\"\n";
  EXPECT_EQ(share(displaced, 3), 0);
  EXPECT_EQ(share(displaced, 0), 1);
  EXPECT_EQ(share("", 0), 0) << "its own mesh, without a declaration";
  EXPECT_EQ(share("", 3), 1);
}

TEST(LightMesh, IsAskedFor) {
  const GlContext gl;
  const RenderScene scene(surface::makePlane(16, 16, 4, 4), test::flatRelief(16, 16), {4, 4},
                          horizon::TableBits::eight);
  const MethodPass pass(shaderFolder(), depthProbe("light_mesh = \"displaced\"\n", 0),
                        relief::Wrap::clamp, TableFilter::exact, {});
  EXPECT_THROW((void)pass.render(atlasView(scene.surface, 4), scene.drawing({0, 0, 1}), {}),
               InternalError);
}

/// A ridge of height 4 over x = 20.5 texels of 48, the map's columns at unit distance; the light
/// comes over it from low x at tan θ = 1/3. It shadows what lies up to 12 behind it.
struct Ridge {
  RenderScene scene{
      surface::makePlane(48, 48, 6, 6), heights(), {4, 48}, horizon::TableBits::thirtyTwo};
  RenderView view = atlasView(scene.surface, 40);
  Vec3 light = glm::normalize(Vec3(-3, 0, 1));

  static relief::Relief heights() {
    std::vector<float> texels(48 * 48, 0);
    for (std::size_t j = 0; j < 48; ++j) texels[48 * j + 20] = 4;
    return worldRelief(48, 48, std::move(texels));
  }

  /// Share of the samples that are not as they must be, those nearer to an edge than 0.1 left out.
  [[nodiscard]] double wrong(const Mask& mask) const {
    const surface::SampleGrid samples = scene.samples(view);
    std::size_t all = 0;
    std::size_t differ = 0;
    for (std::size_t i = 0; i < mask.size(); ++i) {
      const surface::SurfaceSample& sample = samples.samples[i];
      if (!sample.isOnSurface()) continue;
      const double x = scene.surface.evaluate(sample.face, sample.s, sample.t).position.x + 24;
      const double behind = x - 20.5;
      if (std::abs(behind) < 0.1 || std::abs(behind - 12) < 0.1) continue;
      ++all;
      const bool isDark = behind > 0 && behind < 12;
      differ += isDark == (mask.samples[i] == Shade::shadowed) ? 0 : 1;
    }
    return static_cast<double>(differ) / static_cast<double>(all);
  }
};

TEST(TwoScales, CastsTheShadowOfARidge) {
  const GlContext gl;
  const Ridge ridge;
  const Method method = readMethod(methodFile(shaderFolder(), "two-scales"));
  const auto with = [&](const std::map<std::string, double>& values) {
    return ridge.wrong(
        ridge.scene.answer(method, ridge.view, ridge.light, TableFilter::exact, values));
  };
  EXPECT_EQ(with({{"light_pieces", 16}}), 0) << "a mesh with the ridge on its lines";
  EXPECT_LT(with({}), 0.02);
  EXPECT_EQ(ridge.wrong(ridge.scene.answer("two-scales-surface", ridge.view, ridge.light)), 0);
  // Five pieces of six texels cut the ridge: beside its silhouettes the march decides.
  EXPECT_EQ(with({{"light_pieces", 5}, {"edge", 1}}), 0);
  EXPECT_GT(with({{"light_pieces", 5}, {"edge", 0}}), 0.05);
  // All of the depth map's bias is marched, however much it is.
  EXPECT_EQ(with({{"light_pieces", 1}, {"piece_bias", 2}}), 0);
  EXPECT_GT(with({{"light_pieces", 1}, {"piece_bias", 0}, {"edge", 0}}), 0.2) << "no ridge to see";
  EXPECT_GT(ridge.wrong(ridge.scene.answer("unshadowed", ridge.view, ridge.light)), 0.2);
}

// On a plane the march knows its path exactly, so that outlines owe nothing to a map of coarse
// texels.
TEST(TwoScales, LeavesOutlinesToTheMarchWhereItsPathIsKnown) {
  const GlContext gl;
  const Ridge ridge;
  const Method method = readMethod(methodFile(shaderFolder(), "two-scales"));
  const auto with = [&](double trust) {
    return ridge.wrong(ridge.scene.answer(method, ridge.view, ridge.light, TableFilter::exact,
                                          {{"depth_side", 48}, {"bias", 0.25}, {"trust", trust}}));
  };
  EXPECT_EQ(with(1), 0);
  EXPECT_GT(with(0), 0.003);
}

/// A bumpy ring, whose far side shades the near one.
struct Ring {
  explicit Ring(double scale)
      : relief(randomRelief(58, 58, 0.3 * scale, 3)),
        scene(cage(scale), relief, {4, 48}, horizon::TableBits::thirtyTwo) {}
  static surface::Cage cage(double scale) {
    return surface::makeTorus(30 * scale, 10 * scale, 58, 58);
  }
  [[nodiscard]] Mask answer(const std::string& method) const {
    return scene.answer(method, atlasView(scene.surface, 1), light);
  }
  relief::Relief relief;
  RenderScene scene;
  Vec3 light = lightToward(20, 8);
};

TEST(TwoScales, SeesTheFarSideOfABodyWhereAMarchOverTheTextureDoesNot) {
  const GlContext gl;
  const Ring ring(1);
  const RenderView view = cameraView(cameraAt({20, 90, 90}, {0, 0, 0}, 45, 64), ring.scene.mesh);
  const surface::SampleGrid samples = ring.scene.samples(view);
  const Mask truth =
      Rays(DisplacedScene(Ring::cage(1), ring.relief, 2), 2).mask(samples, ring.light);
  const auto error = [&](const std::string& method) {
    const test::Verdict verdict =
        judge(ring.scene.answer(method, view, ring.light), truth, samples);
    return static_cast<double>(verdict.wrong) / static_cast<double>(verdict.lit + verdict.dark);
  };
  EXPECT_LT(error("two-scales"), 0.02);
  EXPECT_LT(error("two-scales-surface"), 0.01);
  EXPECT_GT(error("geodesic-march"), 2 * error("two-scales"));
  EXPECT_GT(error("unshadowed"), 0.02);
}

// Bumps lean to the side along a path that twists, as from the inside of a ring to its far wall:
// what the march would meet there is no shadow, however wide about outlines it is asked.
TEST(TwoScales, EndsItsMarchWhereThePathTwists) {
  const GlContext gl;
  const Ring ring(1);
  const Method method = readMethod(methodFile(shaderFolder(), "two-scales"));
  const RenderView view = cameraView(cameraAt({0, 4, 10}, {0, 0, -30}, 60, 96), ring.scene.mesh);
  const surface::SampleGrid samples = ring.scene.samples(view);
  const Vec3 light = lightToward(30, 25);
  const Mask truth = Rays(DisplacedScene(Ring::cage(1), ring.relief, 2), 2).mask(samples, light);
  const auto wrong = [&](double edge) {
    return judge(ring.scene.answer(method, view, light, TableFilter::exact, {{"edge", edge}}),
                 truth, samples)
        .wrong;
  };
  EXPECT_LT(wrong(0.25), 16);
  EXPECT_LT(wrong(8), 16);
  EXPECT_LT(judge(ring.scene.answer("two-scales-surface", view, light), truth, samples).wrong, 12)
      << "its march knows where the bumps lean";
}

/// Level sheets that share a map of 64 x 64 texels, a texel one unit wide.
struct Sheet {
  Vec3 middle;
  Vec2 size;   ///< multiples of 4
  Vec2 texel;  ///< of its corner
};

surface::Cage sheetsOf(const std::vector<Sheet>& sheets) {
  surface::Cage all;
  for (const Sheet& sheet : sheets) {
    const surface::Cage one =
        surface::makePlane(sheet.size.x, sheet.size.y, static_cast<int>(sheet.size.x / 4),
                           static_cast<int>(sheet.size.y / 4));
    const int vertices = static_cast<int>(all.positions.size());
    const int uvs = static_cast<int>(all.uvs.size());
    for (const Vec3& position : one.positions) all.positions.push_back(position + sheet.middle);
    for (const Vec2& uv : one.uvs) all.uvs.push_back((uv * sheet.size + sheet.texel) / 64.0);
    for (const int vertex : one.faceVertices) all.faceVertices.push_back(vertex + vertices);
    for (const int uv : one.faceUvs) all.faceUvs.push_back(uv + uvs);
  }
  return all;
}

/// Of a method over such sheets, in a light from +x at tan 1/3; against rays.
double shareWrong(const char* method, const surface::Cage& cage, const relief::Relief& relief) {
  const RenderScene scene(cage, relief, {4, 48}, horizon::TableBits::thirtyTwo);
  const RenderView view = atlasView(scene.surface, 8);
  const surface::SampleGrid samples = scene.samples(view);
  const Vec3 light = glm::normalize(Vec3(3, 0, 1));
  const Mask truth = Rays(DisplacedScene(cage, relief, 7), 7).mask(samples, light);
  const test::Verdict verdict = judge(scene.answer(method, view, light), truth, samples);
  return static_cast<double>(verdict.wrong) / static_cast<double>(verdict.lit + verdict.dark);
}

relief::Relief sheetRelief(const std::function<float(int, int)>& height) {
  std::vector<float> texels;
  for (int i = 0; i < 64 * 64; ++i) texels.push_back(height(i % 64, i / 64));
  return {relief::HeightField(64, 64, std::move(texels), relief::Wrap::clamp),
          relief::HeightSpace::world, Vec2(1)};
}

// A march that has passed far over its own chart knows nothing of another part of the surface that
// is nearer: a small sheet 3 over the ground, whose bumps let the march go on for 18.
TEST(TwoScales, SeesAnotherPartBesideItsMarch) {
  const GlContext gl;
  const surface::Cage cage =
      sheetsOf({{{24, 8, 0}, {48, 16}, {0, 0}}, {{22, 8, 3}, {4, 16}, {52, 40}}});
  const relief::Relief relief =
      sheetRelief([](int x, int y) { return x == 44 && y == 2 ? 6.0F : 0.0F; });
  EXPECT_GT(shareWrong("surface-march", cage, relief), 0.05) << "nothing to see";
  EXPECT_LT(shareWrong("two-scales", cage, relief), 0.02);
  EXPECT_LT(shareWrong("two-scales-surface", cage, relief), 0.02);
}

// The depth map is off by how long a piece is, here sixteen times its width, not by the side of a
// square as large. On a plane `geodesic-march` is exact.
TEST(TwoScales, KnowsHowLongAPieceIs) {
  const GlContext gl;
  relief::Relief relief = randomRelief(64, 64, 1, 3);
  relief.field = relief.field.withBorder({true, true});  // as a study has it on an open plane
  const RenderScene scene(surface::makePlane(64, 64, 64, 4), relief, {4, 48},
                          horizon::TableBits::thirtyTwo);
  const RenderView view = atlasView(scene.surface, 4);
  const Vec3 light = lightToward(10, 15);
  const Method method = readMethod(methodFile(shaderFolder(), "two-scales"));
  const Mask exact = scene.answer("geodesic-march", view, light);
  const auto wrong = [&](double pieces) {
    return difference(
        exact, scene.answer(method, view, light, TableFilter::exact, {{"light_pieces", pieces}}));
  };
  EXPECT_LT(wrong(2), 5e-4);
  EXPECT_LT(wrong(4), 5e-4);
  EXPECT_GT(difference(exact, scene.answer("unshadowed", view, light)), 0.02);
}

TEST(TwoScales, KnowsNoUnit) {
  const GlContext gl;
  for (const char* method : {"two-scales", "two-scales-surface", "surface-march"}) {
    const Mask one = Ring(1).answer(method);
    EXPECT_LT(difference(one, Ring(1000).answer(method)), 0.002) << method;
    EXPECT_LT(difference(one, Ring(1e-3).answer(method)), 0.002) << method;
  }
}

}  // namespace
}  // namespace gnomon::render
