#include "report/ci/github_annotations.h"

#include <gmock/gmock.h>

#include <sstream>

#include "report/sample_check.h"
#include "support/lines.h"

namespace gnomon::report {
namespace {

using test::passedCheck;
using test::sampleCheck;
using ::testing::StartsWith;

std::vector<std::string> annotations(const std::vector<study::CheckRecord>& checks) {
  return test::linesOf(githubAnnotations(checks));
}

TEST(GithubAnnotations, AreNoneForWhatPassed) {
  EXPECT_TRUE(annotations({passedCheck()}).empty());
  EXPECT_TRUE(annotations({}).empty());
}

TEST(GithubAnnotations, AreALineForEachFaultThenTheNotices) {
  const std::vector<std::string> lines = annotations({sampleCheck(), passedCheck()});
  ASSERT_EQ(lines.size(), 5U);
  EXPECT_EQ(lines.at(0),
            "::error file=scenes/sample.toml,line=7,title=sample%3A not judged::"
            "scenes/sample.toml:7: 100 %25%0Awrong%0A"
            "gnomon check scenes/sample.toml --method 'a, \"b\" & <c>'");
  EXPECT_EQ(lines.at(1),
            "::error file=scenes/sample.toml,line=12,title=sample%3A threshold failed::"
            "a, \"b\" & <c>, error_rate ≤ 0.0300, camera, elevation 30° azimuth 20°: 0.0512, too "
            "large by 0.0212%0Agnomon check scenes/sample.toml --method 'a, \"b\" & <c>'");
  EXPECT_THAT(lines.at(2), StartsWith("::error file=scenes/sample.toml,line=12,title=sample%3A "
                                      "threshold undefined::"));
  EXPECT_THAT(lines.at(3), StartsWith("::error file=reference/sample.json,title=sample%3A "
                                      "reference failed::"));
  EXPECT_EQ(lines.at(4),
            "::notice file=scenes/sample.toml,line=30,title=sample%3A notice::the limit on x could "
            "be tightened");
}

/// What a change has to mend is the user's shader; the message still says which limit it broke.
TEST(GithubAnnotations, MarkTheUsersOwnShader) {
  study::CheckRecord check = sampleCheck();
  check.shaders["a"] = "shaders/mine.glsl";
  check.problems.front().message = "shaders/mine.glsl:14: error: no function";
  const std::vector<std::string> lines = annotations({check});
  EXPECT_THAT(lines.at(0), StartsWith("::error file=shaders/mine.glsl,line=14,title="));
  check.problems.front().message = "scenes/sample.toml: shaders/mine.glsl:15: error: no function";
  EXPECT_THAT(annotations({check}).at(0), StartsWith("::error file=shaders/mine.glsl,line=15,"));
  EXPECT_THAT(lines.at(1), StartsWith("::error file=scenes/sample.toml,line=12,title="))
      << "of another method";
  EXPECT_THAT(lines.at(2), StartsWith("::error file=shaders/mine.glsl,title=sample%3A threshold"));
  EXPECT_THAT(lines.at(3), StartsWith("::error file=shaders/mine.glsl,title=sample%3A reference"));
}

TEST(GithubAnnotations, EscapeWhatWouldEndAPropertyOrALine) {
  study::CheckRecord check = sampleCheck();
  check.file = "a,b:c%d\r\n.toml";
  check.problems.front().message = "x:y,z\r\n::error::%0A";
  const std::vector<std::string> lines = annotations({check});
  EXPECT_THAT(lines.at(0), StartsWith("::error file=a%2Cb%3Ac%25d%0D%0A.toml,title=sample%3A not "
                                      "judged::x:y,z%0D%0A::error::%250A%0A"));
  for (const std::string& line : lines) {
    EXPECT_TRUE(line.starts_with("::error ") || line.starts_with("::notice ")) << line;
  }
}

TEST(GithubAnnotations, TakeALineOnlyFromTheStudysOwnFile) {
  study::CheckRecord check = sampleCheck();
  for (const char* message : {"other.toml:7: x", "scenes/sample.toml: x", "scenes/sample.toml:7",
                              "scenes/sample.toml:7a: x", "scenes/sample.toml:-3: x"}) {
    check.problems.front().message = message;
    EXPECT_THAT(annotations({check}).at(0), StartsWith("::error file=scenes/sample.toml,title="))
        << message;
  }
}

TEST(GithubAnnotations, HoldUtf8Alone) {
  study::CheckRecord check = sampleCheck();
  check.name = "a\x1b[2J\xff\u202e";
  EXPECT_THAT(annotations({check}).at(0),
              ::testing::HasSubstr("title=a\uFFFD[2J\uFFFD\uFFFD%3A not judged::"));
}

TEST(WithoutWorkflowCommands, BreaksTheSignsThatTheRunnerLooksFor) {
  EXPECT_EQ(withoutWorkflowCommands("::error::x\n  ::set-env name=A::b\na::b\n"),
            ": :error::x\n  : :set-env name=A::b\na::b\n");
  EXPECT_EQ(withoutWorkflowCommands("row ##[error]x ###[group] ##\n##["),
            "row ## [error]x ### [group] ##\n## [");
  EXPECT_EQ(withoutWorkflowCommands(":::"), ": ::");
  EXPECT_EQ(withoutWorkflowCommands(""), "");
}

TEST(WithoutWorkflowCommands, LeavesAllElse) {
  const std::string text = "a: b\n# [x] ## ##a[\n : ok\nκ::κ\n";
  EXPECT_EQ(withoutWorkflowCommands(text), text);
}

}  // namespace
}  // namespace gnomon::report
