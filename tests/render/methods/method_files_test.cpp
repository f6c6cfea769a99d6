#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "common/error.h"
#include "image/images.h"
#include "render/method_text.h"
#include "render/passes/texel_counter.h"
#include "render/render_scene.h"
#include "render/shader_files.h"
#include "support/temporary_folder.h"
#include "truth/truth_scenes.h"

// What a method brings beside its own file: files that it includes, and pictures. And parameters
// that are whole numbers and flags.
// Loops without an end are found before a frame is drawn, and others are not touched.

namespace gnomon::render {
namespace {

using test::lightToward;
using test::methodOfText;
using test::RenderScene;
using test::stepScene;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class MethodFiles : public TemporaryFolder {
 protected:
  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories(file(name).parent_path());
    std::ofstream(file(name)) << text;
  }
  [[nodiscard]] Method method(const std::string& declaration, const std::string& code) const {
    write("mine.glsl",
          "/* gnomon-method\ntitle = \"T\"\ncitation = \"C\"\n" + declaration + "\n*/\n" + code);
    return readMethod(file("mine.glsl"));
  }
  [[nodiscard]] std::string errorOf(const std::function<void()>& work) const {
    try {
      work();
    } catch (const InputError& error) {
      return withoutFolder(error.what());
    }
    return "no error";
  }
  [[nodiscard]] std::string errorOf(const std::string& declaration, const std::string& code) const {
    return errorOf([&] { (void)method(declaration, code); });
  }
};

const std::string asksWrong =
    "bool isShadowed(Pixel pixel, LocalLight light) { return wrong(pixel); }\n";

test::RenderScene flatPlane() {
  return {surface::makePlane(16, 16, 4, 4),
          test::flatRelief(16, 16),
          {4, 4},
          horizon::TableBits::eight};
}

double shareWrong(const test::RenderScene& scene, const Method& method,
                  const std::map<std::string, double>& parameters = {}) {
  return test::shareShadowed(
      scene.test(method, atlasView(scene.surface, 8), {0, 0, 1}, TableFilter::exact, parameters));
}

TEST_F(MethodFiles, AreIncludedOnceInTheirPlace) {
  const GlContext gl;
  write("parts/one.glsl", "#include \"two.glsl\"\nfloat one() { return two() - 1.0; }\n");
  write("parts/two.glsl", "float two() { return 2.0; }\n");
  const Method own = method("",
                            "#include \"parts/one.glsl\"\n  # include  \"parts/two.glsl\"\n"
                            "/* #include \"three.glsl\"\n#include \"three.glsl\" */\n"
                            "// #include \"three.glsl\"\n"
                            "bool wrong(Pixel pixel) { return one() != 1.0; }\n" +
                                asksWrong);
  ASSERT_EQ(own.includes.size(), 2U);
  EXPECT_THAT(own.otherFiles(), ElementsAre(file("parts/one.glsl"), file("parts/two.glsl")));
  EXPECT_EQ(shareWrong(flatPlane(), own), 0);
}

TEST_F(MethodFiles, ErrorsInThemNameTheirOwnLines) {
  const GlContext gl;
  write("one.glsl", "\nfloat one() { return missing; }\n");
  const auto refusal = [&](const std::string& code) {
    return errorOf([&, text = code] {
      const MethodPass pass(shaderFolder(), method("", text + asksWrong), relief::Wrap::repeat,
                            TableFilter::exact, {});
    });
  };
  EXPECT_THAT(
      refusal("#include \"one.glsl\"\nbool wrong(Pixel pixel) { return true; }\n"),
      testing::AllOf(testing::StartsWith("one.glsl:2: "), HasSubstr(" (included at mine.glsl:6)")));
  write("one.glsl", "float one() { return heightAt(vec2(1.0)); }\n");
  EXPECT_THAT(
      refusal("#include \"one.glsl\"\nbool wrong(Pixel pixel) { return true; }\n"),
      testing::AllOf(HasSubstr("one.glsl:1: "),
                     testing::EndsWith("; to use heightAt, declare tables = [\"height\"]")));
  write("one.glsl", "float one() { return 1.0; }\n");
  EXPECT_THAT(refusal("#include \"one.glsl\"\n\nbool wrong(Pixel pixel) { return missing; }\n"),
              HasSubstr("mine.glsl:8: "));
  write("one.glsl", "\n\nvoid one() { discard; }\n");
  EXPECT_THAT(errorOf("", "#include \"one.glsl\"\n" + asksWrong),
              HasSubstr("one.glsl:3: `discard` found"));
}

TEST_F(MethodFiles, ThatCannotBeIncludedAreNamedWithFileAndLine) {
  write("self.glsl", "\n#include \"other.glsl\"\n");
  write("other.glsl", "#include \"self.glsl\"\n");
  write("below/up.glsl", "#include \"../self.glsl\"\n");
  const std::vector<std::pair<std::string, std::string>> faults = {
      {"#include <one.glsl>", "mine.glsl:6: #include \"FILE\" expected, in a line of its own"},
      {"\n#include \"none.glsl\"", "mine.glsl:7: #include \"none.glsl\": no file "},
      {"#include \"../mine.glsl\"",
       "mine.glsl:6: #include \"../mine.glsl\": a file in the folder of the method expected"},
      {"#include \"/etc/passwd\"", ": a file in the folder of the method expected"},
      {"#include \"self.glsl\"", "other.glsl:1: #include \"self.glsl\": this file includes itself"},
      {"#include \"mine.glsl\"", "mine.glsl:6: #include \"mine.glsl\": this file includes itself"},
      {"#include \"below\"", ": no file "},
      {"#include \"below/up.glsl\"", "this file includes itself"},
  };
  for (const auto& [code, expected] : faults) {
    EXPECT_THAT(errorOf("", fmt::format("{}\n{}", code, asksWrong)), HasSubstr(expected)) << code;
  }
  write("long.glsl", std::string(300'000, ' '));
  EXPECT_THAT(errorOf("", "#include \"long.glsl\"\n" + asksWrong),
              HasSubstr("at most 32 files of 262 kB in all expected"));
}

/// What a method needs together with the files that it includes.
TEST_F(MethodFiles, DeclareWhatTheirFunctionsNeed) {
  const GlContext gl;
  const std::string range = "\nminimum = 0\nmaximum = 9\n";
  const auto pass = [](const std::string& name) {
    return "[[pass]]\nname = \"" + name + "\"\nkind = \"texture\"\nchannels = 1\n";
  };
  write("one.glsl", "/* gnomon-part\ntables = [\"height\"]\n" + pass("one") +
                        "[parameters.size]\ndefault = 2" + range +
                        "[parameters.reach]\ndefault = 5" + range + "*/\n#include \"two.glsl\"\n" +
                        "float passOne(Pixel pixel) { return heightAt(pixel.texel) + 7.0; }\n");
  write("two.glsl",
        "/* gnomon-part\ntables = [\"height\", \"horizon\"]\n"
        "[parameters.reach]\ndefault = 6" +
            range + "*/\n");
  write("plain.glsl", "// No declaration.\n");
  const std::string code =
      "#include \"plain.glsl\"\n#include \"one.glsl\"\n"
      "float passMine(Pixel pixel) { return oneTexel(ivec2(pixel.texel)) + size; }\n"
      "bool wrong(Pixel pixel) { return mineTexel(ivec2(pixel.texel)) != 7.0 + 3.0; }\n" +
      asksWrong;
  const Method own = method(pass("mine") + "[parameters.size]\ndefault = 3" + range, code);
  EXPECT_TRUE(own.tables.height && own.tables.horizon && !own.tables.distance);
  ASSERT_EQ(own.passes.own.size(), 2U);
  EXPECT_EQ(own.passes.own[0].name, "one");  // an included file's come first
  EXPECT_EQ(own.passes.own[1].name, "mine");
  EXPECT_EQ(own.parameters.at("size").defaultValue, 3);   // the method's own
  EXPECT_EQ(own.parameters.at("reach").defaultValue, 5);  // of the first of two files
  EXPECT_EQ(shareWrong(flatPlane(), own), 0);
  EXPECT_EQ(shareWrong(flatPlane(), own, {{"size", 4}}), 1);
}

/// A bake may read those before it: an included file's come first, whatever their lines.
TEST_F(MethodFiles, BakeBeforeTheMethodThatIncludesThem) {
  const GlContext gl;
  write("one.glsl",
        "/* gnomon-part\n\n\n\n\n\n[bakes.zero]\nbits = 32\n*/\n"
        "float bakeZero(vec2 texel) { return 7.0; }\n");
  const Method own = method("[bakes.own]\nbits = 32",
                            "#include \"one.glsl\"\n"
                            "float bakeOwn(vec2 texel) { return zeroAt(texel) + 1.0; }\n"
                            "bool wrong(Pixel pixel) { return ownAt(pixel.texel) != 8.0; }\n" +
                                asksWrong);
  ASSERT_EQ(own.bakes.size(), 2U);
  EXPECT_EQ(own.bakes[0].name, "zero");
  EXPECT_EQ(own.bakes[1].name, "own");
  EXPECT_EQ(shareWrong(flatPlane(), own), 0);
}

TEST_F(MethodFiles, FaultsInTheirDeclarationsNameTheirOwnLines) {
  const std::vector<std::pair<std::string, std::string>> faults = {
      {"title = \"T\"", "one.glsl:2: unknown key `title`, expected tables, passes, pass, bakes"},
      {"tables = 3", "one.glsl:2: `tables`: a list expected"},
      {"\ntables = [\"hight\"]", "one.glsl:3: table `hight`, expected height, "},
      {"parameters = 3", "one.glsl:2: `parameters`: a table expected"},
      {"[parameters.k]\ndefault = 3", "one.glsl:2: `minimum` is missing"},
      {"[[pass]]\nname = \"P\"", "one.glsl:3: pass `P`: a name of at most"},
      {"[[pass]]\nname = \"mine\"\nkind = \"texture\"", "mine.glsl:5: a second pass `mine`"},
      {"[bakes.b]\nbits = 3", "one.glsl:3: `bits`"},
      {"tables = [", "one.glsl:2: "},
  };
  for (const auto& [lines, expected] : faults) {
    write("one.glsl", "/* gnomon-part\n" + lines + "\n*/\n");
    EXPECT_THAT(
        errorOf("[[pass]]\nname = \"mine\"\nkind = \"texture\"",
                "#include \"one.glsl\"\nfloat passMine(Pixel pixel) { return 1.0; }\n" + asksWrong),
        HasSubstr(expected))
        << lines;
  }
}

TEST_F(MethodFiles, PicturesAreReadByTheirTexels) {
  const GlContext gl;
  image::Image picture{4, 2, {}};
  for (int i = 0; i < 8; ++i) {
    picture.rgb.insert(picture.rgb.end(), {static_cast<std::uint8_t>(10 * i), 255, 0});
  }
  image::writePng(file("noise.png"), picture);
  const std::string code =
      "bool wrong(Pixel pixel) {\n"
      "  vec4 lowest = noiseTexel(ivec2(1 + 8, -2));\n"  // row 1 of the file, from the top
      "  vec4 between = noiseAt(vec2(2.0, 1.5));\n"      // row 0, between columns 1 and 2
      "  vec4 own = texelFetch(noiseTexture, ivec2(3, 1), 0);\n"
      "  return abs(lowest.r - 50.0 / 255.0) > 1e-5 || lowest.g != 1.0 ||\n"
      "         abs(between.r - 15.0 / 255.0) > 1e-5 || abs(own.r - 30.0 / 255.0) > 1e-5;\n}\n";
  const Method own = method("[textures.noise]\nfile = \"noise.png\"", code + asksWrong);
  EXPECT_EQ(shareWrong(flatPlane(), own), 0);
  const MethodPass pass(shaderFolder(), own, relief::Wrap::repeat, TableFilter::exact, {});
  EXPECT_EQ(pass.textureBytes(), 4U * 2 * 3);

  const std::vector<std::pair<std::string, std::string>> faults = {
      {"[textures.noise]\nfile = \"none.png\"", ":5: `file`: no file "},
      {"[textures.noise]\nfile = \"../noise.png\"",
       ":5: `file`: ../noise.png: a file in the folder"},
      {"[textures.noise]", ":4: `file` is missing"},
      {"[textures.noise]\nfile = \"noise.png\"\nwrap = 3", ":6: unknown key `wrap`"},
      {"[textures.Noise]\nfile = \"noise.png\"", ":4: texture `Noise`: a name of at most"},
  };
  for (const auto& [declaration, expected] : faults) {
    EXPECT_THAT(errorOf(declaration, code + asksWrong), HasSubstr("mine.glsl" + expected));
  }
  write("noise.png", "no picture");
  EXPECT_THAT(errorOf([&] {
                const MethodPass damaged(shaderFolder(), own, relief::Wrap::repeat,
                                         TableFilter::exact, {});
              }),
              HasSubstr("noise.png"));
}

TEST_F(MethodFiles, ParametersAreNumbersWholeNumbersAndFlags) {
  const GlContext gl;
  const Method own = method(
      "[parameters.count]\ndefault = 3\nminimum = 1\nmaximum = 9\ntype = \"int\"\n"
      "[parameters.isOn]\ndefault = true\n"
      "[parameters.size]\ndefault = 3\nminimum = 1\nmaximum = 9\n",
      "bool wrong(Pixel pixel) {\n"
      "  int sum = 0;\n"
      "  for (int k = 0; k < count; ++k) sum += k % 2;\n"
      "  return sum != (isOn ? 1 : 2) || size / 2.0 != 1.5;\n}\n" +
          asksWrong);
  EXPECT_EQ(own.parameters.at("count").kind, ParameterKind::whole);
  EXPECT_EQ(own.parameters.at("isOn").kind, ParameterKind::flag);
  EXPECT_EQ(own.parameters.at("size").kind, ParameterKind::real);
  const test::RenderScene scene = flatPlane();
  EXPECT_EQ(shareWrong(scene, own), 0);
  EXPECT_EQ(shareWrong(scene, own, {{"count", 5}, {"isOn", 0}}), 0);
  EXPECT_EQ(shareWrong(scene, own, {{"count", 5}}), 1);
  EXPECT_THAT(errorOf([&] {
                (void)parameterValue(own, "count", {{"count", 2.5}});
              }),
              HasSubstr("parameter count = 2.5, a whole number from 1 to 9 expected"));
  EXPECT_THAT(errorOf([&] {
                (void)parameterValue(own, "isOn", {{"isOn", 2}});
              }),
              HasSubstr("parameter isOn = 2, true or false expected"));
  const std::vector<std::pair<std::string, std::string>> faults = {
      {"default = 3.5\nminimum = 1\nmaximum = 9\ntype = \"int\"",
       "whole numbers up to 2³⁰ expected"},
      {"default = 3\nminimum = 1\nmaximum = 9\ntype = \"bool\"", ":8: `type`: \"bool\" found"},
      {"default = true\nminimum = 1", ":6: unknown key `minimum`"},
  };
  for (const auto& [lines, expected] : faults) {
    EXPECT_THAT(
        errorOf("[parameters.k]\n" + lines, "bool wrong(Pixel pixel) { return true; }" + asksWrong),
        HasSubstr(expected))
        << lines;
  }
}

/// The samples of 8 × 8 a face, 4 faces, at which a method's loops do not end.
std::vector<std::size_t> endlessOf(const RenderScene& scene, const Method& method,
                                   double radius = 0,
                                   const std::map<std::string, double>& parameters = {}) {
  const relief::Wrap wrap = scene.relief.field.wrap();
  const MethodPass pass(shaderFolder(), method, wrap, TableFilter::exact, parameters);
  const LoopCheck check(shaderFolder(), method, wrap, TableFilter::exact, parameters);
  std::vector<std::size_t> endless;
  scene.withInputs(method, parameters, [&](Drawing drawn, const GpuTables& gpu) {
    drawn.light.direction = lightToward(20, 30);
    drawn.light.radius = radius;
    endless = pass.endlessSamples(atlasView(scene.surface, 8), drawn, gpu, check);
  });
  return endless;
}

std::size_t endlessIn(const RenderScene& scene, const std::string& body) {
  const Method method =
      methodOfText("", "bool isShadowed(Pixel pixel, LocalLight light) {\n  float x = 0.0;\n" +
                           body + "\n  return x > 1.0;\n}\n");
  return endlessOf(scene, method).size();
}

TEST(LoopCheck, KeepsTheTextThatIsNoLoop) {
  for (const std::string text :
       {"float forward = 1.0; // for (;;)\n/* while (true) */ int dodo;", "", "for", "while ("}) {
    EXPECT_EQ(withEndingLoops(text), text);
  }
}

TEST(LoopCheck, EndsEveryKindOfLoop) {
  for (const auto& [loop, ended] : std::vector<std::pair<std::string, std::string>>{
           {"for (int i = 0; i < f(2); ++i) x += 1.0;",
            "for (int i = 0; i < f(2); ++i) if (!nextTurn()) break; else x += 1.0;"},
           {"for(;;) {}", "for (;;) if (!nextTurn()) break; else {}"},
           {"while (g(x)) { x += 1.0; }",
            "while (g(x)) if (!nextTurn()) break; else { x += 1.0; }"},
           {"do { x += 1.0; } while (x < 3.0) ;",
            "do { x += 1.0; } while ((x < 3.0) && nextTurn()) ;"},
           {"while (h());", "while ((h()) && nextTurn());"}}) {
    EXPECT_EQ(withEndingLoops(loop), ended);
  }
}

TEST(LoopCheck, FindsTheSamplesAtWhichALoopDoesNotEnd) {
  const GlContext gl;
  const RenderScene scene = stepScene();
  constexpr std::size_t all = 4 * 8 * 8;
  for (const std::string endless :
       {"for (;;) x += 1.0;", "while (true) { x += 1.0; }", "do x += 1.0; while (x > 0.0);",
        "while (x < 1.0) while (x < 1.0) x *= 0.5;",
        "for (int i = 0; i < 200; ++i) for (int k = 0; k < 200; ++k) x += 0.1;",
        "for (int i = 0; i < 10; --i) { if (x > 5.0) continue; else x += 1.0; }"}) {
    EXPECT_EQ(endlessIn(scene, endless), all) << endless;
  }
  EXPECT_EQ(endlessIn(scene, "while (pixel.texel.x < 8.0) x += 1.0;"), all / 2);
  for (const std::string ends :
       {"x = 2.0;", "for (int i = 0; i < 100; ++i) for (int k = 0; k < 100; ++k) x += 0.1;",
        "for (;;) { x += 1.0; if (x > 9.0) break; }", "do { x += 1.0; } while (x < 100.0);",
        "for (int i = 0; i < 9; ++i) if (x > 5.0) x += 2.0; else x += 1.0;",
        "while (x++ < 30000.0);"}) {
    EXPECT_EQ(endlessIn(scene, ends), 0U) << ends;
  }
}

TEST(LoopCheck, RefusesAPassAndABakeThatDoNotEnd) {
  const GlContext gl;
  const RenderScene scene = stepScene();
  const auto refusal = [&](const Method& method) {
    try {
      (void)endlessOf(scene, method);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string answer = "bool isShadowed(Pixel pixel, LocalLight light) { return false; }\n";
  const std::string pass =
      "[[pass]]\nname = \"one\"\nkind = \"light\"\nclear = 1\nbits = 8\n"
      "[parameters.depth_side]\ndefault = 16\nminimum = 16\nmaximum = 32\n"
      "type = \"int\"\n";
  const std::string ends = "float passOne(Pixel pixel, float depth) { return 1.0; }\n";
  EXPECT_EQ(refusal(methodOfText(pass, ends + answer)), "") << "what is cleared is no fault";
  EXPECT_THAT(refusal(methodOfText(pass,
                                   "float passOne(Pixel pixel, float depth) {\n"
                                   "  float x = depth;\n  while (x >= 0.0) x += 1.0;\n"
                                   "  return x;\n}\n" +
                                       answer)),
              HasSubstr("the loops of its pass `one` turn 32768 times or more at "));
  const Method bakes = methodOfText("[bakes.sky]\nsize = [4, 3]\n",
                                    "float bakeSky(vec2 texel) {\n  float x = 1.0;\n"
                                    "  while (x > 0.0 && texel.x < 8.0) x += 1.0;\n"
                                    "  return 1.0;\n}\n" +
                                        answer);
  const BakePass baking(shaderFolder(), bakes, scene.relief.field.wrap(), TableFilter::exact, {},
                        true);
  try {
    (void)baking.bake(scene.bakeScene(), {});
    ADD_FAILURE() << "it was baked";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("bake `sky`: its loops turn 32768 times or more at 6 of 12 "
                                        "texels"));
  }
}

TEST(LoopCheck, TheProgramsOwnMethodsAllEndAndAnswerWithNumbers) {
  const GlContext gl;
  const RenderScene scene = stepScene();
  const RenderView view = atlasView(scene.surface, 8);
  const Vec3 light = lightToward(20, 30);
  std::size_t looping = 0;
  for (const std::string& name : methodNames(shaderFolder())) {
    const Method method = readMethod(methodFile(shaderFolder(), name));
    const bool isDrawnHere =
        !method.needsCamera() && method.mesh == DrawnMesh::base && !method.tables.surfaceAngles;
    if (!isDrawnHere) continue;
    EXPECT_EQ(scene.answers(method, view, {light}).front().faulty.size(), 0U) << name;
    EXPECT_EQ(scene.shares(method, view, light, radians(2)).faulty.size(), 0U) << name;
    if (!hasLoops(method)) continue;
    EXPECT_EQ(endlessOf(scene, method).size(), 0U) << name;
    EXPECT_EQ(endlessOf(scene, method, radians(2)).size(), 0U) << name;
    ++looping;
  }
  EXPECT_GT(looping, 5U);
}

}  // namespace
}  // namespace gnomon::render
