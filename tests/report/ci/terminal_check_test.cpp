#include "report/ci/terminal_check.h"

#include <gmock/gmock.h>

#include <sstream>

#include "report/sample_check.h"
#include "report/text/text_width.h"
#include "support/lines.h"

namespace gnomon::report {
namespace {

using test::passedCheck;
using test::sampleCheck;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(CheckTable, HasEveryThresholdWithValueLimitMarginAndVerdict) {
  const std::vector<std::string> lines = test::linesOf(checkTable(sampleCheck(), false));
  EXPECT_EQ(lines.at(0), "sample (scenes/sample.toml)");
  EXPECT_EQ(lines.at(1),
            "  method        metric      view, light                         value   limit   "
            "margin  verdict");
  EXPECT_EQ(lines.at(2),
            "  a             error_rate  camera, elevation 30° azimuth 20°  0.0200  ≤ 0.03  "
            "+0.0100  pass");
  EXPECT_EQ(lines.at(3),
            "  a, \"b\" & <c>  error_rate  camera, elevation 30° azimuth 20°  0.0512  ≤ 0.03  "
            "-0.0212  fail");
  EXPECT_EQ(lines.at(4),
            "  a             error_rate  camera, elevation 30° azimuth 20°       –  ≤ 0.04        "
            "–  undefined");
  EXPECT_THAT(lines.at(5), HasSubstr("skipped"));
}

TEST(CheckTable, TellsFaultsInFullWithTheirCommand) {
  const std::string text = checkTable(sampleCheck(), false);
  EXPECT_THAT(text, HasSubstr("reference/sample.json: 0 of 1 references hold"));
  EXPECT_THAT(text, HasSubstr("0.0512, too large by 0.0212"));
  EXPECT_THAT(text, HasSubstr("undefined: no samples"));
  EXPECT_THAT(text, HasSubstr("0.07 committed"));
  EXPECT_THAT(text, HasSubstr("Notice: scenes/sample.toml:30: the limit on x"));
  EXPECT_THAT(text, HasSubstr("\n    gnomon check scenes/sample.toml --method 'a, \"b\" & <c>'\n"));
}

TEST(CheckTable, HasNoCommandForWhatPassed) {
  EXPECT_THAT(checkTable(passedCheck(), false), Not(HasSubstr("Reproduce")));
}

TEST(CheckTable, FitsATerminalWhateverTheNames) {
  study::CheckRecord check = sampleCheck();
  for (study::Judgement& judgement : check.judgements) {
    study::Gate& gate = judgement.gate;
    gate.method = std::string(60, 'm');
    gate.light = std::string(90, 'l');
    gate.metric = "shadow_length_ratio";
    gate.minimum = 0.123456;
    gate.maximum = 1.23456;
    gate.region = "beyond-terminator";
    gate.step = "sample/0.0025";
  }
  const std::string text = checkTable(check, false);
  for (const std::string& line : test::linesOf(text)) {
    if (line.find("gnomon check") != std::string::npos) continue;  // to be copied, so never broken
    EXPECT_LE(displayWidth(line), 100U) << line;
  }
  EXPECT_THAT(text, HasSubstr("0.123456 to 1.23456"));
}

TEST(CheckTable, FitsATerminalWhateverTheLimit) {
  study::CheckRecord check = sampleCheck();
  check.judgements.at(0).gate.maximum = 1e308;
  const std::vector<std::string> lines = test::linesOf(checkTable(check, false));
  EXPECT_THAT(lines.at(2), HasSubstr("≤ 1e+308  +1.000e+308  pass"));
  EXPECT_LE(displayWidth(lines.at(2)), 100U);
}

TEST(CheckTable, HasColoursOnlyWhereTheyAreWanted) {
  EXPECT_THAT(checkTable(sampleCheck(), true), HasSubstr("\x1b[31mfail\x1b[0m"));
  EXPECT_THAT(checkTable(sampleCheck(), false), Not(HasSubstr("\x1b")));
}

TEST(CheckSummary, CountsAndNamesWhatDidNotPass) {
  const std::vector<study::CheckRecord> checks = {passedCheck(), sampleCheck()};
  const std::string text = checkSummary(checks, ExitStatus::badInput, false);
  EXPECT_THAT(text, HasSubstr("Check of 2 studies: 2 of 6 gates passed, 2 failed, 1 undefined, 1 "
                              "skipped, 1 error."));
  EXPECT_THAT(text, HasSubstr("status 3."));
  EXPECT_THAT(text, HasSubstr("Not passed: sample\n"));
  const std::vector<study::CheckRecord> good = {passedCheck()};
  EXPECT_THAT(checkSummary(good, ExitStatus::pass, false), Not(HasSubstr("Not passed")));
}

}  // namespace
}  // namespace gnomon::report
