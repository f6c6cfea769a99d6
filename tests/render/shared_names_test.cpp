#include "render/shared_names.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>

#include "common/error.h"
#include "render/gl_context.h"
#include "render/passes/method_pass.h"
#include "support/temporary_folder.h"

// A method that uses a function, a uniform or a structure without the declaration that provides it
// is told which declaration is missing.

namespace gnomon::render {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

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
