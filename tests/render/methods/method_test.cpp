#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <utility>
#include <vector>

#include "common/error.h"
#include "render/gl_context.h"
#include "render/method.h"
#include "render/passes/method_pass.h"
#include "render/render_scene.h"
#include "render/shared_names.h"
#include "support/temporary_folder.h"
#include "truth/truth_scenes.h"

// A method that uses a function, a uniform or a structure without the declaration that provides it
// is told which declaration is missing.

namespace gnomon::render {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

/// A method file that goes with the test.
class MethodFile {
 public:
  explicit MethodFile(const std::string& text)
      : path_(fs::path(testing::TempDir()) /
              (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) +
               ".glsl")) {
    std::ofstream(path_) << text;
  }
  MethodFile(const MethodFile&) = delete;
  MethodFile& operator=(const MethodFile&) = delete;
  ~MethodFile() { fs::remove(path_); }
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::string errorOf(const std::string& text) {
  const MethodFile file(text);
  try {
    readMethod(file.path());
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Method, EveryShippedMethodDeclaresItself) {
  const fs::path shaders = shaderFolder();
  const auto names = methodNames(shaders);
  EXPECT_GE(names.size(), 3U);
  for (const std::string& name : names) {
    const Method method = readMethod(methodFile(shaders, name));
    EXPECT_EQ(method.name, name);
    EXPECT_FALSE(method.title.empty());
    EXPECT_FALSE(method.citation.empty());
  }
}

TEST(Method, NamesTheLineOfAFaultInItsDeclaration) {
  EXPECT_NE(
      errorOf("bool isShadowed(Pixel p, LocalLight l) { return false; }").find(":1: a comment"),
      std::string::npos);
  EXPECT_NE(errorOf("/* gnomon-method\ntitle = \"T\"\ncitation = 3 = 4\n*/").find(".glsl:3: "),
            std::string::npos);
  EXPECT_NE(errorOf("/* gnomon-method\ntitle = \"T\"\ncitation = \"C\"\ncolour = 1\n*/")
                .find(".glsl:4: unknown key `colour`"),
            std::string::npos);
  EXPECT_NE(errorOf("/* gnomon-method\ncitation = \"C\"\n*/").find("`title` is missing"),
            std::string::npos);
  EXPECT_NE(errorOf("/* gnomon-method\ntitle = \"T\"\ncitation = \"C\"\ntables = [\"hight\"]\n*/")
                .find("table `hight`"),
            std::string::npos);
  EXPECT_NE(
      errorOf("/* gnomon-method\ntitle = \"T\"\ncitation = \"C\"\n[parameters.k]\ndefault = 3\n"
              "minimum = 0\nmaximum = 1\n*/")
          .find("lies outside"),
      std::string::npos);
  EXPECT_NE(errorOf("/* gnomon-method\ntitle = \"T\"").find("a comment"), std::string::npos);
  EXPECT_NE(
      errorOf("/* gnomon-method\ntitle = \"T\"\ncitation = \"C\"\n*/\nfloat f() { return 1.0; }")
          .find("no function `bool isShadowed"),
      std::string::npos);
  EXPECT_THROW(methodFile(shaderFolder(), "no-such-method"), InputError);
}

TEST(Method, RefusesADeclarationThatNestsTooDeep) {
  std::string key = "a";
  for (int i = 0; i < 100'000; ++i) key += ".a";
  for (const std::string& text : {"[" + key + "]", key + " = 1", "x = " + std::string(1000, '[')}) {
    EXPECT_NE(errorOf("/* gnomon-method\ntitle = \"T\"\n" + text + "\n*/")
                  .find(".glsl:3: nested too deep, at most 64 "),
              std::string::npos);
  }
}

TEST(Method, KnowsWhichAnswersItsFileDefines) {
  const std::string head = "/* gnomon-method\ntitle = \"T\"\ncitation = \"C\"\n*/\n";
  const std::string test = "bool isShadowed(Pixel pixel, LocalLight light) {\n  return false;\n}\n";
  const std::string share = "float visibility(Pixel pixel, LocalLight light) { return 1.0; }\n";
  const std::string horizon =
      "float horizonSlope(const Pixel pixel,\n                   LocalLight light)\n{ return 0.0; "
      "}\n";
  const auto answers = [&](const std::string& code) {
    const MethodFile file(head + code);
    const Method method = readMethod(file.path());
    return std::array{method.hasTest, method.answersShares, method.hasHorizon};
  };
  EXPECT_EQ(answers(test), (std::array{true, false, false}));
  EXPECT_EQ(answers(share), (std::array{false, true, false}));
  EXPECT_EQ(answers(horizon), (std::array{false, false, true}));
  EXPECT_EQ(answers(test + share + horizon), (std::array{true, true, true}));
  // The same names elsewhere are no answers.
  EXPECT_EQ(answers("// float visibility(Pixel pixel, LocalLight light)\n"
                    "/* float horizonSlope(Pixel pixel, LocalLight light) */\n"
                    "float visibility(vec2 texel) { return texel.x; }\n"
                    "bool isShadowed(Pixel pixel, LocalLight light) {\n"
                    "  float horizonSlope = 0.0;\n"
                    "  float visibility = (horizonSlope) + float(Pixel(pixel).k1);\n"
                    "  return visibility < 0.0;\n}\n"),
            (std::array{true, false, false}));
}

std::string declared(const std::string& lines, const std::string& code = {}) {
  return "/* gnomon-method\ntitle = \"T\"\ncitation = \"C\"\n" + lines +
         "\n*/\nbool isShadowed(Pixel pixel, LocalLight light) { return false; }\n" + code;
}

TEST(Method, DeclaresPassesMeshAndItsAuthorsNumbers) {
  const MethodFile plain(declared(""));
  const Method none = readMethod(plain.path());
  EXPECT_FALSE(none.passes.texture || none.passes.lightDepth || none.passes.shadowVolumes);
  EXPECT_EQ(none.passes.count(), 1);
  EXPECT_EQ(none.mesh, DrawnMesh::base);
  EXPECT_FALSE(none.subdivisions.has_value());
  EXPECT_FALSE(none.azimuths.has_value());

  const MethodFile file(
      declared("tables = [\"surface-angles\", \"ellipse\"]\n"
               "passes = [\"texture\", \"light-depth\", \"shadow-volumes\"]\n"
               "mesh = \"displaced\"\nsubdivisions = 9\nazimuths = 8\n"
               "[parameters.depth_side]\ndefault = 64\nminimum = 1\nmaximum = 99",
               "float resolveTexel(Pixel pixel) { return 0.0; }\n"));
  const Method all = readMethod(file.path());
  EXPECT_TRUE(all.passes.texture && all.passes.lightDepth && all.passes.shadowVolumes);
  EXPECT_EQ(all.passes.count(), 5);  // depth and volumes are two
  EXPECT_EQ(all.mesh, DrawnMesh::displaced);
  EXPECT_EQ(all.subdivisions, 9);
  EXPECT_EQ(all.azimuths, 8);
  EXPECT_TRUE(all.tables.surfaceAngles && all.tables.ellipse);
  EXPECT_FALSE(all.tables.angles || all.tables.horizon);

  EXPECT_FALSE(all.lightMesh.has_value());
  const MethodFile base(declared("mesh = \"base\""));
  EXPECT_EQ(readMethod(base.path()).mesh, DrawnMesh::base);
}

TEST(Method, DeclaresANormalOfItsOwn) {
  const std::string normal = "vec3 shadingNormal(Pixel pixel) { return pixel.normal; }\n";
  const MethodFile none(declared(""));
  EXPECT_FALSE(readMethod(none.path()).hasOwnNormal);
  const MethodFile own(declared("normal = \"own\"", normal));
  EXPECT_TRUE(readMethod(own.path()).hasOwnNormal);

  const std::vector<std::array<std::string, 3>> faults = {
      {"normal = \"mine\"", normal, ".glsl:4: normal `mine`, expected own"},
      {"normal = 1", normal, ".glsl:4: normal ``, expected own"},
      {"normal = \"own\"", "", ".glsl:4: `normal` needs the function `vec3 shadingNormal("},
      {"normal = \"own\"\nmesh = \"displaced\"", normal, ".glsl:4: `normal` needs mesh = \"base\""},
      {"", normal, "needs the declaration normal = \"own\""},
  };
  for (const auto& [lines, code, message] : faults) {
    EXPECT_NE(errorOf(declared(lines, code)).find(message), std::string::npos) << lines;
  }
}

/// A method whose light sees a mesh of its own, with that many pieces at most.
std::string ofTwoMeshes(const std::string& lines, int most = 64) {
  return lines + "\n[parameters.depth_side]\ndefault = 64\nminimum = 1\nmaximum = 99\n" +
         "[parameters.light_pieces]\ndefault = 9\nminimum = 1\nmaximum = " + std::to_string(most);
}

TEST(Method, DeclaresTheMeshOfItsLight) {
  const MethodFile file(
      declared(ofTwoMeshes("passes = [\"light-depth\"]\nlight_mesh = \"displaced\"")));
  const Method method = readMethod(file.path());
  EXPECT_EQ(method.mesh, DrawnMesh::base);
  EXPECT_EQ(method.lightMesh, DrawnMesh::displaced);
  EXPECT_EQ(lightPieces(method, {}), 9);
  EXPECT_EQ(lightPieces(method, {{"light_pieces", 12}}), 12);
  EXPECT_THROW((void)lightPieces(method, {{"light_pieces", 2.5}}), InputError);
  EXPECT_THROW((void)lightPieces(method, {{"light_pieces", 65}}), InputError);
}

TEST(Method, NamesTheLineOfAFaultInTheMeshOfItsLight) {
  const std::string depth = "passes = [\"light-depth\"]\n";
  const std::string light = "light_mesh = \"displaced\"";
  const std::vector<std::pair<std::string, std::string>> faults = {
      {depth + "light_mesh = \"base\"", ".glsl:5: light_mesh `base`, expected displaced"},
      {"light_mesh = 3", ".glsl:4: light_mesh ``, expected displaced"},
      {light, ".glsl:4: `light_mesh` needs passes = [\"light-depth\"]"},
      {depth + "mesh = \"displaced\"\n" + light, ".glsl:6: `light_mesh` needs mesh = \"base\""},
      {depth + light, ".glsl:5: `light_mesh` needs the parameter light_pieces"},
      {ofTwoMeshes(depth + light, 2000),
       ".glsl:5: the parameter light_pieces: a range within 1 … 1024 expected"},
  };
  for (const auto& [lines, message] : faults) {
    const std::string error = errorOf(declared(lines));
    EXPECT_NE(error.find(message), std::string::npos) << lines << "\n" << error;
    EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 0) << error;
  }
}

TEST(Method, NamesTheLineOfAFaultInItsPassesMeshOrNumbers) {
  const std::vector<std::pair<std::string, std::string>> faults = {
      {"passes = [\"txture\"]",
       ".glsl:4: pass `txture`, expected texture, light-depth, shadow-volumes"},
      {"tables = []\npasses = \"texture\"", ".glsl:5: `passes`: a list expected"},
      {"passes = [3]", ".glsl:4: pass ``"},
      {"mesh = \"fine\"", ".glsl:4: mesh `fine`, expected base or displaced"},
      {"\nmesh = 3", ".glsl:5: mesh"},
      {"subdivisions = 0", ".glsl:4: `subdivisions`: a whole number from 1 to 1024 expected"},
      {"subdivisions = 1025", ".glsl:4: `subdivisions`"},
      {"subdivisions = 2.5", ".glsl:4: `subdivisions`"},
      {"\n\nazimuths = -8", ".glsl:6: `azimuths`: a whole number from 1 to 1024 expected"},
      {"azimuths = \"8\"", ".glsl:4: `azimuths`"},
      {"passes = [\"light-depth\"]", ": pass `light-depth` needs the parameter depth_side"},
      {"passes = [\"shadow-volumes\"]", ": pass `shadow-volumes` needs mesh = \"displaced\""},
      {"passes = [\"texture\"]", ": pass `texture` needs the function `float resolveTexel"},
      {"tables = [\"angles\", \"surface-angles\"]",
       ": tables `angles` and `surface-angles`, one expected"},
  };
  for (const auto& [lines, message] : faults) {
    const std::string error = errorOf(declared(lines));
    EXPECT_NE(error.find(message), std::string::npos) << lines << "\n" << error;
    EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 0) << error;
    EXPECT_NE(error.find(".glsl:"), std::string::npos) << error;
    EXPECT_EQ(error.find(".glsl:0"), std::string::npos) << error;
  }
}

TEST(Method, EveryShippedMethodCompilesAndOneMayLeaveAnythingOut) {
  const GlContext gl;
  const fs::path shaders = shaderFolder();
  for (const std::string& name : methodNames(shaders)) {
    const Method method = readMethod(methodFile(shaders, name));
    for (const relief::Wrap wrap : {relief::Wrap::repeat, relief::Wrap::clamp}) {
      EXPECT_NO_THROW(MethodPass(shaders, method, wrap, TableFilter::exact, {})) << name;
      EXPECT_NO_THROW(MethodPass(shaders, method, wrap, TableFilter::hardware, {})) << name;
    }
  }
}

TEST(MethodPass, TexturePassLeavesOutTexelsThatTheSurfaceDoesNotHave) {
  const GlContext gl;
  const MethodFile file(
      "/* gnomon-method\ntitle = \"T\"\ncitation = \"C\"\npasses = [\"texture\"]\n*/\n"
      "float resolveTexel(Pixel pixel) { return 1.0; }\n"
      "bool isShadowed(Pixel pixel, LocalLight light) { return resolvedAt(pixel.texel) != 1.0; "
      "}\n");
  // The chart ends at 11.4 of 16 texels: the centre of texel 11 lies beyond.
  surface::Cage cage = surface::makePlane(16, 16, 4, 4);
  for (Vec2& uv : cage.uvs) uv *= 11.4 / 16;
  cage.grid.reset();
  const test::RenderScene scene(cage, test::flatRelief(16, 16), {4, 4}, horizon::TableBits::eight);
  EXPECT_EQ(scene.texture.width, 12);
  const RenderView view = atlasView(scene.surface, 20);
  EXPECT_EQ(test::shareShadowed(scene.answer(readMethod(file.path()), view, {0, 0, 1})), 0);
}

TEST(MethodPass, TexturePassNeedsNoTables) {
  const GlContext gl;
  // What the texture pass leaves comes back between texels as bilinear values, in any number of
  // bits.
  const MethodFile file(
      "/* gnomon-method\ntitle = \"T\"\ncitation = \"C\"\npasses = [\"texture\"]\n*/\n"
      "float resolveTexel(Pixel pixel) { return floor(pixel.texel.x) / 16.0; }\n"
      "bool isShadowed(Pixel pixel, LocalLight light) {\n"
      "  float expected = clamp((pixel.texel.x - 0.5) / 16.0, 0.0, 15.0 / 16.0);\n"
      "  return abs(resolvedAt(pixel.texel) - expected) > 1e-6;\n}\n");
  const Method method = readMethod(file.path());
  const test::RenderScene scene(surface::makePlane(16, 16, 4, 4), test::flatRelief(16, 16), {4, 4},
                                horizon::TableBits::eight);
  const RenderView view = atlasView(scene.surface, 20);
  EXPECT_EQ(test::shareShadowed(scene.answer(method, view, {0, 0, 1})), 0);
  // 16² texels of a value and of a mark that the texel is there, each a float.
  const MethodPass pass(shaderFolder(), method, relief::Wrap::clamp, TableFilter::exact, {});
  EXPECT_EQ(pass.passBytes(nullptr, scene.drawing({0, 0, 1}), {}), 16U * 16 * 2 * 4);
}

TEST(MethodPass, NamesFileAndLineThatDoNotCompile) {
  const GlContext gl;
  const MethodFile file(
      "/* gnomon-method\ntitle = \"T\"\ncitation = \"C\"\n*/\n\n"
      "bool isShadowed(Pixel pixel, LocalLight light) {\n  return missing;\n}\n");
  try {
    const MethodPass pass(shaderFolder(), readMethod(file.path()), relief::Wrap::clamp,
                          TableFilter::exact, {});
    FAIL() << "it compiled";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(file.path().string() + ":7: "), std::string::npos)
        << error.what();
  }
}

TEST(MethodPass, SeesOnlyTheTablesItDeclares) {
  const GlContext gl;
  const MethodFile file(
      "/* gnomon-method\ntitle = \"T\"\ncitation = \"C\"\ntables = [\"height\"]\n*/\n"
      "bool isShadowed(Pixel pixel, LocalLight light) { return horizonAt(pixel.texel, 0.0) > 0.0; "
      "}\n");
  EXPECT_THROW(MethodPass(shaderFolder(), readMethod(file.path()), relief::Wrap::clamp,
                          TableFilter::exact, {}),
               InputError);
}

TEST(MethodPass, TakesParameters) {
  const GlContext gl;
  const MethodFile file(
      "/* gnomon-method\ntitle = \"T\"\ncitation = \"C\"\n[parameters.edge]\ndefault = 8\nminimum "
      "= 0\n"
      "maximum = 16\n*/\n"
      "bool isShadowed(Pixel pixel, LocalLight light) { return pixel.texel.x < edge; }\n");
  const Method method = readMethod(file.path());
  const test::RenderScene scene(surface::makePlane(16, 16, 4, 4), test::flatRelief(16, 16), {4, 4},
                                horizon::TableBits::eight);
  const RenderView view = atlasView(scene.surface, 4);
  const auto share = [&](const std::map<std::string, double>& values) {
    return test::shareShadowed(scene.answer(method, view, {0, 0, 1}, TableFilter::exact, values));
  };
  EXPECT_DOUBLE_EQ(share({}), 0.5);
  EXPECT_DOUBLE_EQ(share({{"edge", 4}}), 0.25);
  EXPECT_THROW(share({{"edge", 17}}), InputError);
  EXPECT_THROW(share({{"ridge", 1}}), InputError);
}

class SharedNames : public TemporaryFolder {
 protected:
  /// What the compiler says of a method with this declaration and body.
  [[nodiscard]] std::string refusal(const std::string& declaration, const std::string& body) const {
    std::ofstream(file("mine.glsl"))
        << "/* gnomon-method\ntitle = \"T\"\ncitation = \"C\"\n"
        << declaration << "\n*/\nbool isShadowed(Pixel pixel, LocalLight light) {\n  " << body
        << "\n}\n";
    const GlContext gl;
    try {
      const MethodPass pass(shaderFolder(), readMethod(file("mine.glsl")), relief::Wrap::repeat,
                            TableFilter::exact, {});
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(SharedNames, AnUndeclaredFunctionNamesItsTable) {
  const std::string message = refusal("", "return heightAt(pixel.texel) > 1.0;");
  EXPECT_THAT(message, HasSubstr("mine.glsl:7: "));
  EXPECT_THAT(message, EndsWith(R"(; to use heightAt, declare tables = ["height"])"));
  EXPECT_THAT(message, Not(HasSubstr("\n")));
}

TEST_F(SharedNames, EveryKindOfDeclarationIsNamed) {
  const auto ending = [this](const std::string& body) {
    return refusal("", "return " + body + ";");
  };
  EXPECT_THAT(ending("horizonAt(pixel.texel, 0.0) > 0.0"),
              EndsWith(R"(horizonAt, declare tables = ["horizon"])"));
  EXPECT_THAT(ending("distanceAt(pixel.texel, 0.0) > 0.0"),
              EndsWith(R"(distanceAt, declare tables = ["distance"])"));
  EXPECT_THAT(ending("ellipseAt(pixel.texel).centre.x > 0.0"),
              EndsWith(R"(ellipseAt, declare tables = ["ellipse"])"));
  EXPECT_THAT(ending("angleOfCosine(0.5) > 0.0"),
              EndsWith(R"(angleOfCosine, declare tables = ["angles"] or ["surface-angles"])"));
  EXPECT_THAT(ending("resolvedAt(pixel.texel) > 0.0"),
              EndsWith(R"(resolvedAt, declare passes = ["texture"])"));
  EXPECT_THAT(ending("lightDepthOf(ivec2(0)) > 0.0"),
              EndsWith(R"(lightDepthOf, declare passes = ["light-depth"])"));
  EXPECT_THAT(ending("shadowCount() > 0u"),
              EndsWith(R"(shadowCount, declare passes = ["shadow-volumes"])"));
  EXPECT_THAT(ending("facetNormal(pixel).x > 0.0"),
              EndsWith(R"(facetNormal, declare mesh = "displaced")"));
}

TEST_F(SharedNames, SoDoesAUniformAndAStructure) {
  EXPECT_THAT(refusal("", "return searchRadius > 1.0;"),
              EndsWith(R"(searchRadius, declare tables = ["height"])"));
  EXPECT_THAT(refusal("", "Path path = makePath(pixel, light); return path.limit > 1.0;"),
              EndsWith(R"(Path, declare tables = ["height"])"));
  EXPECT_THAT(refusal("", "return tableEntry(mine, vec2(1.0), ivec2(0), 0) > 0.0;"),
              HasSubstr("mine"));
}

TEST_F(SharedNames, OtherFaultsGetNoHint) {
  const std::string declared = R"(tables = ["height"])";
  EXPECT_EQ(refusal(declared, "return heightAt(pixel.texel) > 1.0;"), "");
  EXPECT_THAT(refusal(declared, "return heightAt(1) > 1.0;"),
              AllOf(HasSubstr("heightAt"), Not(HasSubstr("needs"))));
  EXPECT_THAT(refusal("", "return unheardOf(pixel.texel) > 1.0;"),
              AllOf(HasSubstr("unheardOf"), Not(HasSubstr("needs"))));
  EXPECT_THAT(refusal(declared, "return isTurnedAway(pixel);"), Not(HasSubstr("needs")));
}

TEST_F(SharedNames, AMistypedNameIsAnsweredByTheNearestThereIs) {
  const std::string declared = R"(tables = ["height"])";
  EXPECT_THAT(refusal(declared, "return heigthAt(pixel.texel) > 1.0;"),
              AllOf(HasSubstr("mine.glsl:7: "), EndsWith("; did you mean heightAt?")));
  EXPECT_THAT(refusal("", "return heigthAt(pixel.texel) > 1.0;"),
              EndsWith(R"(; did you mean heightAt? To use it, declare tables = ["height"])"));
  EXPECT_THAT(refusal("", "return normalise(pixel.normal).z > 1.0;"),
              EndsWith("; did you mean normalize?"));
  EXPECT_THAT(refusal("[bakes.sky]\n",
                      "return skyyAt(pixel.texel) > 1.0;\n}\n"
                      "float bakeSky(vec2 texel) { return 1.0;"),
              EndsWith("; did you mean skyAt?"));
  // A name that is like none may be a bake's.
  EXPECT_THAT(refusal(declared, "return occlusionAt(pixel.texel) > 1.0;"),
              EndsWith("; to use occlusionAt, declare [bakes.occlusion]"));
}

TEST_F(SharedNames, AMemberIsLookedForInTheStructures) {
  for (const std::string wrong : {"worldPerTexel", "pixel.worldPerTexel"}) {
    EXPECT_THAT(refusal("", "return " + wrong + " > 1.0;"),
                AllOf(HasSubstr("mine.glsl:7: "), Not(HasSubstr("bakes")),
                      EndsWith("; worldPerTexel is a member of LocalLight")))
        << wrong;
  }
  EXPECT_THAT(refusal("", "return pixel.worldPerHeigth > 1.0;"),
              EndsWith("; did you mean worldPerHeight?"));
}

TEST_F(SharedNames, AWrongCallIsToldTheSignature) {
  const std::string declared = R"(tables = ["height"])";
  const auto message = refusal(declared, "return heightAt(1, 2) > 1.0;");
  EXPECT_THAT(message, AllOf(HasSubstr("mine.glsl:7: "), Not(HasSubstr("candidates")),
                             EndsWith("; the signature is float heightAt(vec2 at)")));
  EXPECT_THAT(refusal(declared, "return heightAt(pixel.texel).slope > 1.0;"),
              EndsWith("; the signature is float heightAt(vec2 at)"));
  EXPECT_THAT(refusal(declared, "return heightCell(1).fraction.x > 1.0;"),
              AllOf(HasSubstr("; the signatures are Cell heightCell(vec2 at"),
                    HasSubstr(" and Cell heightCell(vec2 at")));
}

TEST_F(SharedNames, ErrorsInSharedFilesNameALineOfTheMethod) {
  // Defined again by shading.glsl, which follows.
  EXPECT_THAT(refusal("", "return true;\n}\nbool isTurnedAway(Pixel pixel) {\n  return true;"),
              AllOf(HasSubstr("mine.glsl:9: "), HasSubstr("shading.glsl:")));
  // A brace that is missing is missed where the next file begins.
  const std::string open = refusal("", "if (pixel.texel.x > 0.0) {\n  return true;");
  EXPECT_THAT(open, AllOf(HasSubstr("mine.glsl:9: "), HasSubstr("after the end of this file")));
  // Declared and not defined: told by the linker, which knows no line.
  EXPECT_THAT(refusal("",
                      "return later(pixel);\n}\nbool earlier() {\n  return true;\n}\n"
                      "bool later(Pixel pixel);\nbool last() {\n  return true;"),
              HasSubstr("mine.glsl:"));
}

TEST_F(SharedNames, EveryDefineHasItsDeclaration) {
  const auto names = sharedNames(shaderFolder());
  ASSERT_GT(names.size(), 60U);
  for (const SharedName& shared : names) {
    for (const std::string& define : shared.defines) {
      EXPECT_NE(declarationFor(define), "") << shared.file << ": " << shared.name;
    }
  }
  const auto isThere = [&](const char* name) {
    return std::any_of(names.begin(), names.end(),
                       [&](const SharedName& shared) { return shared.name == name; });
  };
  for (const char* name : {"pi", "texel", "vertexLight", "lightDirection", "Pixel", "Crossings",
                           "bareHorizon", "wrapTexel", "angleOrigin", "facetNormal"}) {
    EXPECT_TRUE(isThere(name)) << name;
  }
  EXPECT_FALSE(isThere("shadingNormal")) << "it follows the method";
}

}  // namespace
}  // namespace gnomon::render
