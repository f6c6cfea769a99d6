// Shaders that crash an OpenGL driver or take all memory in it, and shaders that leave out pixels:
// the run names method and file.

#include <fmt/core.h>
#include <gmock/gmock.h>

#include "end_to_end/support/program.h"
#include "support/replaced.h"
#include "support/test_length.h"

namespace gnomon::test {
namespace {

using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;

class HostileShaders : public EndToEnd {
 protected:
  /// Runs the small study with a method of this body beside its own.
  Outcome runWith(const std::string& body, const std::vector<std::string>& environment = {}) {
    write("mine.glsl",
          "/* gnomon-method\ntitle = \"t\"\ncitation = \"c\"\n*/\n"
          "bool isShadowed(Pixel pixel, LocalLight light) {\n" +
              body + "\n}\n");
    write("own.toml", smallStudy() + "\n[[method]]\nfile = \"mine.glsl\"\nlabel = \"own\"\n");
    return gnomon({"run", "own.toml"}, environment);
  }

  /// Runs the small study under a light of this radius with a method of this declaration and code.
  Outcome runCode(const std::string& declaration, const std::string& code, int radius) {
    write("mine.glsl",
          "/* gnomon-method\ntitle = \"t\"\ncitation = \"c\"\n" + declaration + "*/\n" + code);
    const std::string light = "elevation = 30\nradius = " + std::to_string(radius) + "\n";
    write("own.toml", replaced(smallStudy(), "elevation = 30\n", light) +
                          "\n[[method]]\nfile = \"mine.glsl\"\nlabel = \"own\"\n");
    return gnomon({"run", "own.toml"});
  }

  /// Refused in one line, with nothing left behind.
  void expectRefused(const Outcome& outcome, const std::string& says) {
    EXPECT_EQ(outcome.status, 3) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("mine.glsl"), HasSubstr(says)));
    EXPECT_FALSE(std::filesystem::exists(file("out/own/summary.json")));
  }

  static std::string sumOf(int terms) {
    std::string text = "  return 1.0";
    for (int i = 1; i < terms; ++i) text += "+1.0";
    return text + " > 0.5;";
  }
};

TEST_F(HostileShaders, AreBoundInLength) {
  const Outcome outcome = runWith(sumOf(100000));
  expectRefused(outcome, "a shader of at most 262 kB expected");
}

TEST_F(HostileShaders, AreTriedInAProcessOfTheirOwn) {
  int caught = 0;
  std::vector<std::string> bodies = {sumOf(60000), "  float a = 0.0;\n" + std::string(60000, '(') +
                                                       "a" + std::string(60000, ')') +
                                                       ";\n  return a > 0.5;"};
  if (repetitions(0, 1) == 1) {
    bodies.emplace_back(
        "  float a[100000000];\n  for (int i = 0; i < 100000000; ++i) a[i] = float(i);\n"
        "  return a[int(pixel.texel.x)] > 0.5;");
    bodies.emplace_back("  float a = 0.0;\n  while (a < 1.0) a *= 0.5;\n  return a > 0.5;");
  }
  for (const std::string& body : bodies) {
    const Outcome outcome = runWith(body);
    // A driver may well be able to.
    if (outcome.status == 0) continue;
    ++caught;
    SCOPED_TRACE(body.substr(0, 40));
    expectRefused(outcome, "");
    EXPECT_THAT(outcome.err,
                AnyOf(HasSubstr("own.toml: method \"own\" ("), HasSubstr("own.toml: mine.glsl:")));
  }
  fmt::print("faults: {} hostile shaders, {} refused\n", bodies.size(), caught);
}

TEST_F(HostileShaders, ThatDiscardAreNamedWithTheLine) {
  expectRefused(runWith("  // discard here\n  if (pixel.texel.x > 9.0) discard;\n  return false;"),
                "mine.glsl:7: `discard` found: method mine");
  const Outcome mentioned =
      runWith("  /* no\n discard */ bool discarded = false;\n  return discarded;");
  EXPECT_EQ(mentioned.status, 0) << mentioned.err;
}

TEST_F(HostileShaders, ThatLeaveOutPixelsOtherwiseAreNamed) {
  expectRefused(runWith("  gl_FragDepth = pixel.texel.x > 9.0 ? 1.0 : 0.5;\n  return false;"),
                "method \"own\" (");
}

TEST_F(HostileShaders, ThatAnswerWithNoNumberAreNamedByViewLightAndSamples) {
  const std::string share = "float visibility(Pixel pixel, LocalLight light) { return ";
  const std::string nothing = "uintBitsToFloat(0x7fc00000u)";
  const std::string isFew = "pixel.texel.x > 15.0 && pixel.texel.y > 15.0 ? ";
  for (const std::string& wrong : {nothing, std::string("1.5"), std::string("-0.5")}) {
    for (const int radius : {0, 4}) {
      const Outcome outcome = runCode("", share + isFew + wrong + " : 0.75; }\n", radius);
      expectRefused(outcome, "method \"own\" (");
      EXPECT_THAT(outcome.err,
                  AllOf(HasSubstr("its `visibility` is no number or not from 0 to 1 at "),
                        HasSubstr(" samples of view \"camera\" under light \"evening\"")));
    }
  }
  expectRefused(runCode("",
                        "float horizonSlope(Pixel pixel, LocalLight light) { return " + isFew +
                            nothing + " : 0.1; }\n",
                        0),
                "its `horizonSlope` is no number at ");
  expectRefused(runCode("normal = \"own\"\n",
                        "vec3 shadingNormal(Pixel pixel) { return 2.0 * pixel.normal; }\n"
                        "bool isShadowed(Pixel pixel, LocalLight light) { return false; }\n",
                        0),
                "its `shadingNormal` is no unit vector at ");
  // The ends themselves, rounding, and a horizon that is everywhere or nowhere, are answers.
  for (const std::string right : {"0.0", "1.0", "1.00001"}) {
    EXPECT_EQ(runCode("", share + isFew + right + " : 0.75; }\n", 4).status, 0) << right;
  }
  EXPECT_EQ(runCode("",
                    "float horizonSlope(Pixel pixel, LocalLight light) { return " + isFew +
                        "uintBitsToFloat(0x7f800000u) : -1e30; }\n",
                    0)
                .status,
            0);
}

TEST_F(HostileShaders, ThatNeverEndAreNamedByViewLightAndSamples) {
  const std::vector<std::string> endless = {
      "  float a = 0.0;\n  while (a < 1.0) a *= 0.5;\n  return a > 0.5;",
      "  float a = 0.0;\n  while (pixel.texel.x > 30.0 && a < 1.0) for (;;) a *= 0.5;\n"
      "  return a > 0.5;"};
  for (const std::string& body : endless) {
    const Outcome outcome = runWith(body);
    expectRefused(outcome, "its loops turn 32768 times or more at ");
    EXPECT_THAT(outcome.err, HasSubstr(" samples of view \"camera\" under light \"evening\""));
  }
}

}  // namespace
}  // namespace gnomon::test
