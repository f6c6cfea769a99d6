#include "render/method.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "common/error.h"
#include "render/render_scene.h"
#include "truth/truth_scenes.h"

namespace gnomon {
namespace {

namespace fs = std::filesystem;

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

TEST(MethodPass, NamesFileAndLineThatDoNotCompile) {
  const GlContext gl;
  const MethodFile file(
      "/* gnomon-method\ntitle = \"T\"\ncitation = \"C\"\n*/\n\n"
      "bool isShadowed(Pixel pixel, LocalLight light) {\n  return missing;\n}\n");
  try {
    const MethodPass pass(shaderFolder(), readMethod(file.path()), Wrap::clamp, TableFilter::exact,
                          {});
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
  EXPECT_THROW(
      MethodPass(shaderFolder(), readMethod(file.path()), Wrap::clamp, TableFilter::exact, {}),
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
  const test::RenderScene scene(makePlane(16, 16, 4, 4), test::flatRelief(16, 16), {4, 4},
                                TableBits::eight);
  const RenderView view = atlasView(scene.surface, 4);
  const auto share = [&](const std::map<std::string, double>& values) {
    return test::shareShadowed(scene.answer(method, view, {0, 0, 1}, TableFilter::exact, values));
  };
  EXPECT_DOUBLE_EQ(share({}), 0.5);
  EXPECT_DOUBLE_EQ(share({{"edge", 4}}), 0.25);
  EXPECT_THROW(share({{"edge", 17}}), InputError);
  EXPECT_THROW(share({{"ridge", 1}}), InputError);
}

}  // namespace
}  // namespace gnomon
