#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "common/error.h"
#include "render/passes/own_pass.h"
#include "render/render_scene.h"
#include "support/temporary_folder.h"

// Passes of a method's own: what one stores is what the next and the answer read.
// A method that brings a bake, two passes, an include and a whole number, on ground whose shadows
// are known: a bar across a plane, under lights along the axes.

namespace gnomon::render {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

class OwnPasses : public TemporaryFolder {
 protected:
  [[nodiscard]] Method method(const std::string& declaration, const std::string& code,
                              const std::string& wrong = "  return true;") const {
    std::ofstream(file("mine.glsl"))
        << "/* gnomon-method\ntitle = \"T\"\ncitation = \"C\"\n"
        << declaration << "\n*/\n"
        << code << "\nbool isShadowed(Pixel pixel, LocalLight light) {\n"
        << wrong << "\n}\n";
    return readMethod(file("mine.glsl"));
  }
  [[nodiscard]] std::string errorOf(const std::string& declaration, const std::string& code) const {
    try {
      (void)method(declaration, code);
    } catch (const InputError& error) {
      return withoutFolder(error.what());
    }
    return "no error";
  }
};

const std::string sideOfLight =
    "[parameters.depth_side]\ndefault = 64\nminimum = 1\nmaximum = 99\ntype = \"int\"\n";

test::RenderScene passPlane(int texels) {
  return {surface::makePlane(texels, texels, 4, 4),
          test::flatRelief(texels, texels),
          {4, 4},
          horizon::TableBits::eight};
}

Camera cameraAbove(int side) {
  Camera camera;
  camera.eye = {3, -5, 30};
  camera.width = camera.height = side;
  return camera;
}

TEST_F(OwnPasses, OverTheTextureAreReadBetweenItsTexels) {
  const GlContext gl;
  const test::RenderScene scene = passPlane(16);
  const Method own = method(
      "[[pass]]\nname = \"place\"\nkind = \"texture\"\nchannels = 3\n"
      "[[pass]]\nname = \"sum\"\nkind = \"filter\"\nof = \"place\"\nchannels = 1",
      "vec3 passPlace(Pixel pixel) { return vec3(pixel.texel, 7.0); }\n"
      "float passSum(ivec2 texel) {\n"
      "  return dot(placeTexel(texel).xy, vec2(1.0)) + float(texel.x);\n}\n",
      "  vec2 within = clamp(pixel.texel, vec2(0.5), vec2(15.5));\n"
      "  vec3 place = placeAt(pixel.texel);\n"
      "  return distance(place, vec3(within, 7.0)) > 1e-4 ||\n"
      "         abs(sumAt(pixel.texel) - (2.0 * within.x + within.y - 0.5)) > 1e-4;");
  EXPECT_EQ(own.passes.count(), 3);
  EXPECT_EQ(test::shareShadowed(scene.test(own, atlasView(scene.surface, 20), {0, 0, 1})), 0);
  const MethodPass pass(shaderFolder(), own, relief::Wrap::clamp, TableFilter::exact, {});
  // Three values and a mark; a value and a mark.
  EXPECT_EQ(pass.passBytes(nullptr, scene.drawing({0, 0, 1}), {}), 16U * 16 * 4 * (4 + 2));
}

TEST_F(OwnPasses, FromTheLightHoldItsRasterAndTheirLevelsItsMean) {
  const GlContext gl;
  // A plane seen from above fills the middle of the map: depth ½, and the share of the ball's
  // square that it covers is side² / (diameter of the ball)² = ½.
  const test::RenderScene scene = passPlane(16);
  const Method own = method(
      "[[pass]]\nname = \"moments\"\nkind = \"light\"\nchannels = 2\nmips = true\n"
      "[[pass]]\nname = \"wide\"\nkind = \"filter\"\nof = \"moments\"\nchannels = 2\n"
      "[[pass]]\nname = \"ramp\"\nkind = \"filter\"\nof = \"wide\"\n" +
          sideOfLight,
      "vec2 passMoments(Pixel pixel, float depth) { return vec2(depth, 1.0); }\n"
      "float passRamp(ivec2 texel) { return float(texel.x + 100 * texel.y); }\n"
      "vec2 passWide(ivec2 texel) {\n"
      "  return 0.5 * (momentsTexel(texel - ivec2(8, 0)) + momentsTexel(texel + ivec2(8, "
      "0)));\n}\n",
      "  vec3 place = lightMapPlace(pixel.position);\n"
      "  vec2 whole = momentsTexel(ivec2(0), 6);\n"
      "  vec2 near = momentsAt(place.xy);\n"
      "  vec2 mixed = mix(momentsAt(place.xy, 1.0), momentsAt(place.xy, 2.0), 0.5);\n"
      "  bool isInside = all(lessThan(abs(pixel.position.xy), vec2(3.0)));\n"
      "  bool isNear = !isInside || distance(near, vec2(0.5, 1.0)) < 1e-3;\n"
      "  bool isWide = !isInside || distance(wideAt(place.xy), vec2(0.5, 1.0)) < 1e-3;\n"
      "  float ramp = dot(place.xy - 0.5, vec2(1.0, 100.0));\n"
      "  return !isNear || !isWide || abs(rampAt(place.xy) - ramp) > 1e-2 || distance(whole, "
      "vec2(0.25, 0.5)) > 0.02 ||\n"
      "         distance(momentsAt(place.xy, 1.5), mixed) > 1e-5 ||\n"
      "         abs(lightDepthOf(ivec2(32)) - 0.5) > 1e-3 || depth_side != 64;");
  EXPECT_EQ(own.passes.count(), 4);
  EXPECT_EQ(test::shareShadowed(scene.test(own, atlasView(scene.surface, 8), {0, 0, 1})), 0);
  const MethodPass pass(shaderFolder(), own, relief::Wrap::clamp, TableFilter::exact, {});
  const double levels = 4.0 / 3;
  EXPECT_EQ(pass.passBytes(nullptr, scene.drawing({0, 0, 1}), {}),
            static_cast<std::uint64_t>(64 * 64 * levels * 8) + 64 * 64 * (8 + 4 + 4));
}

TEST_F(OwnPasses, ACamerasDepthAndPassesTellItsPixels) {
  const GlContext gl;
  const test::RenderScene scene = passPlane(16);
  const Method own = method(
      "passes = [\"camera-depth\"]\n[[pass]]\nname = \"seen\"\nkind = \"camera\"\nchannels = 4\n"
      "clear = [0, 0, 0, 5]",
      "vec4 passSeen(Pixel pixel) { return vec4(pixel.position, 1.0); }\n",
      "  vec3 eye = vec3(3.0, -5.0, 30.0);\n"
      "  ivec2 other = ivec2(31) - ivec2(gl_FragCoord.xy);\n"
      "  vec4 seen = seenTexel(other);\n"
      "  vec3 point = cameraPoint(vec3(vec2(other) + 0.5, cameraDepthOf(other)));\n"
      "  bool isSame = seen.w == 5.0 ? cameraDepthOf(other) == 1.0 : distance(point, seen.xyz) < "
      "0.01;\n"
      "  vec3 place = cameraPlace(pixel.position);\n"
      "  return !isSame || distance(place.xy, gl_FragCoord.xy) > 1e-2 ||\n"
      "         distance(viewDirection(pixel), normalize(eye - pixel.position)) > 1e-5 ||\n"
      "         cameraPlace(2.0 * eye).z > -1e8;");
  EXPECT_TRUE(own.needsCamera());
  const RenderView view = cameraView(cameraAbove(32), scene.mesh);
  const Mask mask = scene.test(own, view, {0, 0, 1});
  EXPECT_EQ(test::shareShadowed(mask), 0);
  EXPECT_GT(std::count(mask.samples.begin(), mask.samples.end(), Shade::none), 0);
  EXPECT_FALSE(method("", "").needsCamera());
  EXPECT_TRUE(method("needs = \"camera\"", "").needsCamera());
}

TEST_F(OwnPasses, SeeNoPassAfterThem) {
  const GlContext gl;
  const test::RenderScene scene = passPlane(16);
  const Method own = method(
      "[[pass]]\nname = \"first\"\nkind = \"texture\"\n[[pass]]\nname = \"last\"\n"
      "kind = \"texture\"",
      "float passFirst(Pixel pixel) { return lastTexel(ivec2(3)); }\n"
      "float passLast(Pixel pixel) { return 1.0; }",
      "  return !isnan(firstTexel(ivec2(3))) || lastTexel(ivec2(3)) != 1.0;");
  EXPECT_EQ(test::shareShadowed(scene.test(own, atlasView(scene.surface, 8), {0, 0, 1})), 0);
}

TEST_F(OwnPasses, NameTheLineOfAFaultInTheirDeclaration) {
  const std::string one = "[[pass]]\nname = \"one\"\nkind = \"texture\"\n";
  const std::string code = "float passOne(Pixel pixel) { return 1.0; }\n";
  const std::vector<std::pair<std::string, std::string>> faults = {
      {"pass = 3", ":4: `pass`: tables `[[pass]]` expected"},
      {"[[pass]]\nkind = \"light\"", ":4: `name` is missing"},
      {"[[pass]]\nname = \"One\"", ":5: pass `One`: a name of at most 40"},
      {"[[pass]]\nname = \"one\"", ":4: `kind` is missing"},
      {"[[pass]]\nname = \"one\"\nkind = \"sky\"",
       ":6: kind `sky`, expected texture, light, camera or filter"},
      {one + "side = 3", ":7: unknown key `side`, expected name, kind"},
      {one + "channels = 4", ":7: `channels`: a whole number from 1 to 3 expected"},
      {one + "bits = 24", ":7: `bits`: 8, 16 or 32 expected"},
      {one + "of = \"one\"", ":7: `of` needs kind = \"filter\""},
      {one + "clear = 1", ":7: `clear` needs kind = \"light\" or \"camera\""},
      {one + "mips = true", ":7: `mips` needs a pass from the light or a camera"},
      {one + one, ":8: a second pass `one`"},
      {"[[pass]]\nname = \"one\"\nkind = \"filter\"", ":4: `of` is missing"},
      {"[[pass]]\nname = \"one\"\nkind = \"filter\"\nof = \"one\"",
       ":7: `of`: no pass `one` before this one"},
      {"[[pass]]\nname = \"one\"\nkind = \"light\"",
       ":1: a pass from the light needs the parameter depth_side"},
      {"[[pass]]\nname = \"eye\"\nkind = \"camera\"\n" + one,
       ":7: pass `one` comes after a camera's"},
      {"[[pass]]\nname = \"two\"\nkind = \"camera\"",
       ":4: pass `two` needs the function `float passTwo(Pixel pixel)`"},
      {one + "[bakes.one]", ":7: bake `one` needs the function `float bakeOne(vec2 texel)`"},
      {"needs = \"atlas\"", ":4: needs `atlas`, expected camera"},
  };
  for (const auto& [declaration, expected] : faults) {
    EXPECT_THAT(errorOf(declaration, code), HasSubstr("mine.glsl" + expected)) << declaration;
  }
  EXPECT_THAT(errorOf(one + "[bakes.one]", code + "float bakeOne(vec2 texel) { return 1.0; }\n"),
              HasSubstr("two of its bakes, textures and passes are `one`, one expected"));
}

TEST_F(OwnPasses, AreNamedWhereTheirDeclarationIsMissing) {
  const GlContext gl;
  const auto refusal = [&](const std::string& code, const std::string& wrong) {
    try {
      const MethodPass pass(shaderFolder(), method("", code, wrong), relief::Wrap::repeat,
                            TableFilter::exact, {});
    } catch (const InputError& error) {
      return withoutFolder(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(refusal("float passMoments(Pixel pixel) { return 1.0; }",
                      "  return momentsAt(pixel.texel) > 0.0;"),
              EndsWith("; to use momentsAt, declare [[pass]] name = \"moments\""));
  EXPECT_THAT(refusal("", "  return texelFetch(noiseTexture, ivec2(0), 0).r > 0.0;"),
              EndsWith("; to use noiseTexture, declare [textures.noise]"));
  EXPECT_THAT(refusal("", "  return viewDirection(pixel).x > 0.0;"),
              EndsWith("; to use viewDirection, declare needs = \"camera\""));
  EXPECT_THAT(refusal("", "  return cameraDepthOf(ivec2(0)) > 0.0;"),
              EndsWith("; to use cameraDepthOf, declare passes = [\"camera-depth\"]"));
}

constexpr int barTexels = 64;
constexpr double barHeight = 6;

Method sixteenth() {
  const std::filesystem::path tests =
      std::filesystem::path(GNOMON_SCENES).parent_path() / "tests/render";
  return readMethod(tests / "sixteenth/sixteenth.glsl");
}

/// How far a place is from the side of the bar's shadow, texels; above 0 inside it. The bar is
/// from texel 30 to 34 of an axis, and heights fall to 0 within a texel beside it.
double insideShadow(double along, bool towardHigher, double length) {
  const double way = towardHigher ? 30 - along : along - 34;
  return std::min(way, length - way);
}

/// A bar that stands across x, or across y.
relief::Relief bar(bool acrossX) {
  return test::stepRelief(barTexels, barTexels, barHeight, [acrossX](int x, int y) {
    const int along = acrossX ? x : y;
    return along >= 30 && along < 34;
  });
}

TEST(SixteenthMethod, ShadowsABarAsLongAsItMustBe) {
  const GlContext gl;
  const Method method = sixteenth();
  EXPECT_EQ(method.passes.count(), 3);
  ASSERT_EQ(method.includes.size(), 1U);
  const double length = 20;
  const double elevation = std::atan(barHeight / length);
  for (int axis = 0; axis < 4; ++axis) {
    const bool acrossX = axis % 2 == 0;
    const test::RenderScene scene(surface::makePlane(barTexels, barTexels, 4, 4), bar(acrossX),
                                  {4, 64}, horizon::TableBits::eight);
    const double azimuth = axis * pi / 2;
    const Vec3 light(std::cos(azimuth) * std::cos(elevation),
                     std::sin(azimuth) * std::cos(elevation), std::sin(elevation));
    const RenderView view = atlasView(scene.surface, 32);
    const surface::SampleGrid samples =
        SamplesPass(shaderFolder()).render(view, GpuMesh(scene.mesh));
    for (const auto& [reach, reached] : {std::pair(40, length), std::pair(10, 10.0)}) {
      const Mask mask = scene.test(method, view, light, TableFilter::exact,
                                   {{"reach", static_cast<double>(reach)}});
      std::size_t inside = 0;
      for (std::size_t i = 0; i < mask.size(); ++i) {
        const surface::SurfaceSample& sample = samples.samples[i];
        const Vec3 place = scene.surface.evaluate(sample.face, sample.s, sample.t).position;
        const double along = (acrossX ? place.x : place.y) + barTexels / 2.0;
        const double depth = insideShadow(along, axis < 2, reached);
        if (std::abs(depth) < 2 || (along > 29 && along < 35)) continue;
        EXPECT_EQ(mask.samples[i], depth > 0 ? Shade::shadowed : Shade::lit)
            << "light " << axis << " at " << along;
        inside += depth > 0 ? 1 : 0;
      }
      EXPECT_GT(inside, 100U);
    }
  }
}

}  // namespace
}  // namespace gnomon::render
