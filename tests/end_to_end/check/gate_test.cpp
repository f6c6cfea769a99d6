#include <gmock/gmock.h>

#include "end_to_end/support/program.h"

// The committed thresholds catch a shader that is wrong, and pass the one that they are for: a gate
// that nothing fails is none. That every scene passes as it is: the tests named `check.SCENE`.

namespace gnomon::test {
namespace {

using ::testing::HasSubstr;

class CommittedGates : public EndToEnd, public ::testing::WithParamInterface<const char*> {
 protected:
  [[nodiscard]] Outcome check(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {"check",
                                          std::string(GNOMON_SCENES "/") + GetParam() + ".toml",
                                          "--quick", "--method", "onoue-2004"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return gnomon(arguments);
  }
};

class CatchAFault : public CommittedGates {};

TEST_P(CatchAFault, AFlippedSignOfEquationTwo) {
  const Outcome outcome =
      check({"--replace", "onoue-2004=" GNOMON_OWN_METHODS "/flipped-onoue-2004.glsl"});
  EXPECT_EQ(outcome.status, 1) << outcome.err << outcome.out;
  EXPECT_THAT(outcome.out, HasSubstr("onoue-2004, error_rate ≤ "));
  EXPECT_THAT(outcome.out, HasSubstr("too large by"));
  EXPECT_EQ(summary(GetParam()).at("methods").at(0).at("name"), "flipped-onoue-2004");
}

INSTANTIATE_TEST_SUITE_P(Scenes, CatchAFault,
                         ::testing::Values("figure6", "figure7", "figure8", "saddle",
                                           "sloan-cylinder", "sphere-cells", "sphere-columns",
                                           "torus"));

class TellMethodsApart : public CommittedGates {};

TEST_P(TellMethodsApart, TheFlatMethodFailsTheCurvatureAwareOnes) {
  EXPECT_EQ(check({"--replace", "onoue-2004=max-forsyth"}).status, 1);
}

TEST_P(TellMethodsApart, AnotherFileOfTheSameMethodPasses) {
  EXPECT_EQ(check({"--replace", "onoue-2004=onoue-2004"}).status, 0);
}

INSTANTIATE_TEST_SUITE_P(Scenes, TellMethodsApart,
                         ::testing::Values("figure6", "figure7", "figure8", "sphere-cells",
                                           "sphere-columns", "torus"));

}  // namespace
}  // namespace gnomon::test
