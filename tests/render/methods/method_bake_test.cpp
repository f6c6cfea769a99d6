#include "render/bakes/bake_pass.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <numeric>

#include "common/error.h"
#include "render/render_scene.h"
#include "support/temporary_folder.h"

// Tables that methods bake by functions of their own: what is baked is what the function says, and
// what is read is what was baked.

namespace gnomon::render {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;

class MethodBakes : public TemporaryFolder {
 protected:
  [[nodiscard]] Method method(const std::string& declaration, const std::string& code) const {
    std::ofstream(file("mine.glsl")) << "/* gnomon-method\ntitle = \"T\"\ncitation = \"C\"\n"
                                     << declaration << "\n*/\n"
                                     << code;
    return readMethod(file("mine.glsl"));
  }
  /// One whose test is `wrong`, of a pixel.
  [[nodiscard]] Method checking(const std::string& declaration, const std::string& bakes,
                                const std::string& wrong) const {
    return method(declaration,
                  bakes + "\nbool isShadowed(Pixel pixel, LocalLight light) {\n" + wrong + "\n}\n");
  }
  [[nodiscard]] std::string errorOf(const std::function<void()>& work) const {
    try {
      work();
    } catch (const InputError& error) {
      return withoutFolder(error.what());
    }
    return "no error";
  }
};

constexpr int bakedSide = 24;

test::RenderScene bakedPlane(const relief::Relief& relief) {
  return {
      surface::makePlane(bakedSide, bakedSide, 4, 4), relief, {4, 8}, horizon::TableBits::eight};
}
test::RenderScene bakedRandom() {
  return bakedPlane(test::randomRelief(bakedSide, bakedSide, 4, 7));
}

std::vector<float> floatsOf(const StoredBake& bake) {
  std::vector<float> values(bake.entry(bake.levels));
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = bake.values.value(i);
  return values;
}

TEST_F(MethodBakes, HoldWhatTheirFunctionSaysOfEveryTexelAndLayer) {
  const GlContext gl;
  const test::RenderScene scene = bakedRandom();
  const Method own =
      checking("[bakes.place]\nchannels = 3\nbits = 32\nlayers = 5\nsize = [48, 7]",
               "vec3 bakePlace(vec2 texel, int layer) { return vec3(texel, float(layer)); }",
               "  return placeTexel(ivec2(3, 2), 4).z != 4.0;");
  const StoredBake bake = scene.storedBakes(own, {}).front();
  EXPECT_EQ(std::tuple(bake.width, bake.height, bake.layers, bake.channels, bake.levels),
            std::tuple(48, 7, 5, 3, 1));
  const std::vector<float> values = floatsOf(bake);
  ASSERT_EQ(values.size(), 48U * 7 * 5 * 3);
  for (std::size_t i = 0; i < values.size() / 3; ++i) {
    EXPECT_FLOAT_EQ(values[3 * i], (static_cast<float>(i % 48) + 0.5F) * bakedSide / 48);
    EXPECT_FLOAT_EQ(values[3 * i + 1], (static_cast<float>(i / 48 % 7) + 0.5F) * bakedSide / 7);
    EXPECT_EQ(values[3 * i + 2], static_cast<float>(i / (48 * 7)));
  }
  EXPECT_EQ(test::shareShadowed(scene.answer(own, atlasView(scene.surface, 8), {0, 0, 1})), 0);
  EXPECT_EQ(bytesOver(own.bakes.front(), {bakedSide, bakedSide}), 48U * 7 * 5 * 3 * 4);
  EXPECT_EQ(scene.bakes(own, {}).front().byteCount(), 48U * 7 * 5 * 3 * 4);
}

TEST_F(MethodBakes, OfTheMapAreReadAsTheMap) {
  const GlContext gl;
  const test::RenderScene scene = bakedRandom();
  // Heights up to 4, in codes of 16 bits: half a step and the rounding of floats.
  const Method own = checking("tables = [\"height\"]\n[bakes.copy]\nbits = 16\nrange = [0, 4]",
                              "float bakeCopy(vec2 texel) { return heightAt(texel); }",
                              "  vec2 at = 3.0 * pixel.texel - 20.0;\n"
                              "  return abs(copyAt(at) - heightAt(at)) > 4.0 / 65535.0;");
  const RenderView view = atlasView(scene.surface, 20);
  EXPECT_EQ(test::shareShadowed(scene.test(own, view, {0, 0, 1})), 0);
  // The GPU's own filter has fewer bits.
  const Method wide = checking(
      "tables = [\"height\"]\n[bakes.copy]\nbits = 32",
      "float bakeCopy(vec2 texel) { return heightAt(texel); }",
      "  vec2 at = 3.0 * pixel.texel - 20.0;\n  return abs(copyAt(at) - heightAt(at)) > 0.05;");
  EXPECT_EQ(test::shareShadowed(scene.test(wide, view, {0, 0, 1}, TableFilter::hardware)), 0);
}

TEST_F(MethodBakes, GoOnAsTheMapDoes) {
  const GlContext gl;
  relief::Relief clamped = test::randomRelief(bakedSide, bakedSide, 4, 7);
  clamped.field = relief::HeightField(
      bakedSide, bakedSide, {clamped.field.texels().begin(), clamped.field.texels().end()},
      relief::Wrap::clamp);
  const test::RenderScene scene = bakedPlane(clamped);
  const Method own =
      checking("tables = [\"height\"]\n[bakes.copy]\nbits = 32",
               "float bakeCopy(vec2 texel) { return heightAt(texel); }",
               "  vec2 at = 3.0 * pixel.texel - 20.0;\n"
               "  return abs(copyAt(at) - heightAt(at)) > 1e-5 || copyTexel(ivec2(-9, 3)) != "
               "copyTexel(ivec2(0, 3));");
  EXPECT_EQ(test::shareShadowed(scene.test(own, atlasView(scene.surface, 20), {0, 0, 1})), 0);
}

TEST_F(MethodBakes, ReadBakesBeforeThemTablesAndParameters) {
  const GlContext gl;
  const test::RenderScene scene = bakedRandom();
  const Method own = checking(
      "tables = [\"horizon\"]\n[bakes.twice]\nbits = 32\n[bakes.half]\nbits = 32\nscale = 0.5\n"
      "[parameters.factor]\ndefault = 2\nminimum = 0\nmaximum = 9\n"
      "[parameters.other]\ndefault = 2\nminimum = 0\nmaximum = 9",
      "float bakeTwice(vec2 texel) { return factor * horizonAt(texel, 0.0); }\n"
      "float bakeHalf(vec2 texel) { return twiceAt(texel); }",
      "  float expected = factor * horizonAt(2.0 * floor(0.5 * pixel.texel) + 1.0, 0.0);\n"
      "  return abs(halfTexel(ivec2(floor(0.5 * pixel.texel))) - expected) > 1e-5 + other * 0.0;");
  EXPECT_EQ(own.bakes.at(0).name, "twice");
  EXPECT_EQ(own.bakes.at(1).name, "half") << "as the declaration has them, not the alphabet";
  const RenderView view = atlasView(scene.surface, 12);
  EXPECT_EQ(
      test::shareShadowed(scene.test(own, view, {0, 0, 1}, TableFilter::exact, {{"factor", 3}})),
      0);
  const BakePass pass(shaderFolder(), own, relief::Wrap::repeat, TableFilter::exact,
                      {{"factor", 3}});
  EXPECT_EQ(pass.parameters(), (std::map<std::string, double>{{"factor", 3}}))
      << "another parameter bakes nothing again";
}

TEST_F(MethodBakes, LevelsFollowTheirRule) {
  const GlContext gl;
  const test::RenderScene scene = bakedRandom();
  const Method own = checking(
      "tables = [\"height\"]\n[bakes.levels]\nchannels = 3\nbits = 32\nsize = [21, 13]\n"
      "mips = [\"minimum\", \"average\", \"maximum\"]",
      "vec3 bakeLevels(vec2 texel) { return vec3(heightAt(texel)); }",
      "  vec3 top = levelsAt(pixel.texel, 9.0);\n"
      "  vec3 mixed = levelsAt(pixel.texel, 1.25);\n"
      "  vec3 expected = mix(levelsAt(pixel.texel, 1.0), levelsAt(pixel.texel, 2.0), 0.25);\n"
      "  return top != levelsTexel(ivec2(5, 7), 4) || distance(mixed, expected) > 1e-5;");
  const StoredBake bake = scene.storedBakes(own, {}).front();
  EXPECT_EQ(bake.levels, 5);  // 21 × 13, 10 × 6, 5 × 3, 2 × 1, 1
  EXPECT_EQ(bake.sizeOf(3), glm::ivec2(2, 1));
  const std::vector<float> values = floatsOf(bake);
  double sum = 0;
  float low = values.front();
  float high = low;
  for (std::size_t i = 0; i < bake.entry(1); i += 3) {
    sum += static_cast<double>(values[i]);
    low = std::min(low, values[i]);
    high = std::max(high, values[i]);
  }
  const std::size_t last = bake.entry(4);
  EXPECT_EQ(values[last], low);
  EXPECT_NEAR(static_cast<double>(values[last + 1]), sum / (21 * 13), 1e-5);
  EXPECT_EQ(values[last + 2], high);
  EXPECT_EQ(test::shareShadowed(scene.test(own, atlasView(scene.surface, 12), {0, 0, 1})), 0);
}

TEST_F(MethodBakes, ACoarserTexelStandsForAllBelowIt) {
  // Three texels below one: the middle ones lie below both.
  const std::vector<float> row = {1, 2, 6, 4, 5};
  EXPECT_THAT(coarser(row, {5, 1}, {MipRule::average}),
              testing::ElementsAre(testing::FloatEq((1 + 2 + 3) / 2.5F),
                                   testing::FloatEq((3 + 4 + 5) / 2.5F)));
  EXPECT_EQ(coarser(row, {5, 1}, {MipRule::maximum}), (std::vector<float>{6, 6}));
  EXPECT_EQ(coarser(row, {1, 5}, {MipRule::minimum}), (std::vector<float>{1, 4}));
  EXPECT_EQ(coarser(std::vector<float>{1, 10, 2, 20, 3, 30, 4, 40}, {2, 2},
                    {MipRule::minimum, MipRule::average}),
            (std::vector<float>{1, 25}));
}

TEST_F(MethodBakes, OfManyRowsAreWhatOneRowWouldBe) {
  const GlContext gl;
  const test::RenderScene scene = bakedRandom();
  const Method own = checking("[bakes.row]\nbits = 32\nsize = [3, 4097]",
                              "float bakeRow(vec2 texel) { return texel.y; }",
                              "  return rowTexel(ivec2(0)) < 0.0;");
  const std::vector<float> values = floatsOf(scene.storedBakes(own, {}).front());
  for (std::size_t i = 0; i < values.size(); ++i) {
    ASSERT_FLOAT_EQ(values[i], (static_cast<float>(i / 3) + 0.5F) * bakedSide / 4097);
  }
}

TEST_F(MethodBakes, KnowNoPixelNoLightAndNoLaterBake) {
  const GlContext gl;
  const test::RenderScene scene = bakedRandom();
  for (const std::string what : {"lightDirection.x", "lightRadius", "position.y", "laterAt(texel)",
                                 "earlyAt(texel)", "1.0 / (heightBounds.x - heightBounds.x)"}) {
    const Method own = checking("tables = [\"height\"]\n[bakes.early]\n[bakes.later]",
                                "float bakeEarly(vec2 texel) { return " + what +
                                    "; }\n"
                                    "float bakeLater(vec2 texel) { return 1.0; }",
                                "  return laterAt(pixel.texel) < 0.5;");
    const std::string message = errorOf([&] { (void)scene.storedBakes(own, {}); });
    EXPECT_THAT(message, AllOf(HasSubstr("method mine: bake `early`: "),
                               HasSubstr(" found at texel (0, 0) of layer 0, a finite number")))
        << what;
  }
}

TEST_F(MethodBakes, TooLargeAreRefusedBeforeTheyAreMade) {
  const GlContext gl;
  const auto refusal = [&](const std::string& size) {
    const Method own =
        checking("[bakes.large]\n" + size, "float bakeLarge(vec2 texel, int layer) { return 1.0; }",
                 "  return true;");
    return errorOf([&] { requireBakeSizes(own, {8192, 8192}); });
  };
  EXPECT_THAT(
      refusal("scale = 64\nlayers = 2"),
      HasSubstr("method mine: bake `large`: 524288 × 524288 texels × 2 layers found, OpenGL "
                "takes at most "));
  EXPECT_EQ(refusal("scale = 0.01\nlayers = 2"), "no error");
  const Method many =
      checking("[bakes.large]\nlayers = 2000\nbits = 32\nchannels = 4",
               "vec4 bakeLarge(vec2 texel, int layer) { return vec4(1.0); }", "  return true;");
  EXPECT_THROW(requireBakeSizes(many, {8192, 8192}), MemoryError);
}

TEST_F(MethodBakes, NameTheLineOfAFaultInTheirDeclaration) {
  const std::vector<std::pair<std::string, std::string>> faults = {
      {"bakes = 3", ":4: `bakes`: a table expected"},
      {"[bakes.one]\ntexels = 3", ":5: unknown key `texels`, expected channels, bits"},
      {"[bakes.One]", ":4: bake `One`: a name of at most 40 letters"},
      {"[bakes.o_ne]", ":4: bake `o_ne`: a name"},
      {"[bakes.one]\nchannels = 5", ":5: `channels`: a whole number from 1 to 4 expected"},
      {"[bakes.one]\nbits = 10", ":5: `bits`: 8, 16 or 32 expected"},
      {"[bakes.one]\nrange = [1, 0]", ":5: `range`: a low end below the high end expected"},
      {"[bakes.one]\nrange = [1]", ":5: `range`: [low, high] expected"},
      {"[bakes.one]\nbits = 32\nrange = [0, 1]", ":6: `range` needs bits = 8 or 16"},
      {"[bakes.one]\nchannels = 2\nrange = [[0, 1]]", ":6: `range`: 1 pairs found, one for each"},
      {"[bakes.one]\nscale = 0", ":5: `scale`: a number above 0 and up to 64 expected"},
      {"[bakes.one]\nscale = 1\nsize = [1, 1]", ":5: `scale` and `size`, one expected"},
      {"[bakes.one]\nsize = [1, 1.5]", ":5: `size`: whole numbers from 1 to 65536 expected"},
      {"[bakes.one]\nsize = 3", ":5: `size`: [width, height] expected"},
      {"[bakes.one]\nlayers = 0", ":5: `layers`: a whole number from 1 to 2048 expected"},
      {"[bakes.one]\nmips = true", ":5: `mips`: average, minimum or maximum expected"},
      {"[bakes.one]\nmips = [\"average\", \"average\"]", ":5: `mips`: 2 found, one for each of 1"},
      {"[bakes.one]\nfilter = \"cubic\"", ":5: `filter`: linear or nearest expected"},
      {"[bakes.two]", ":4: bake `two` needs the function `float bakeTwo(vec2 texel)`"},
      {"[bakes.one]\nlayers = 2\nchannels = 2",
       ":4: bake `one` needs the function `vec2 bakeOne(vec2 texel, int layer)`"},
  };
  for (const auto& [declaration, expected] : faults) {
    const std::string message = errorOf([&, text = declaration] {
      (void)checking(text, "float bakeOne(vec2 texel) { return 1.0; }", "  return true;");
    });
    EXPECT_THAT(message, HasSubstr("mine.glsl" + expected)) << declaration;
  }
}

TEST_F(MethodBakes, TheCompilersMessagesNameFileLineAndDeclaration) {
  const GlContext gl;
  const auto refusal = [&](const std::string& declaration, const std::string& bakes,
                           const std::string& wrong) {
    return errorOf([&] {
      const Method own = checking(declaration, bakes, wrong);
      const MethodPass pass(shaderFolder(), own, relief::Wrap::repeat, TableFilter::exact, {});
    });
  };
  const std::string one = "float bakeOne(vec2 texel) { return 1.0; }";
  EXPECT_THAT(refusal("", "", "  return occlusionAt(pixel.texel) > 0.5;"),
              AllOf(HasSubstr("mine.glsl:8: "),
                    EndsWith("; to use occlusionAt, declare [bakes.occlusion]")));
  EXPECT_THAT(
      refusal("[bakes.one]", one, "  return twoTexel(ivec2(0)) > oneTexel(ivec2(0));"),
      AllOf(HasSubstr("mine.glsl:8: "), EndsWith("; to use twoTexel, declare [bakes.two]")));
  EXPECT_THAT(refusal("[bakes.one]", one, "  return oneAt(3) > 0.5;"),
              AllOf(HasSubstr("mine.glsl:8: "), testing::Not(HasSubstr("needs"))));
  EXPECT_THAT(
      refusal("[bakes.height]", "float bakeHeight(vec2 texel) { return 1.0; }", "  return true;"),
      HasSubstr("mine.glsl: the declaration's `height`: heightAt of relief.glsl has that name"));
}

}  // namespace
}  // namespace gnomon::render
