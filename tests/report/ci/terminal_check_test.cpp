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

// Six digits of one figure beside two of the other tell nobody by how much a limit is missed.
TEST(CheckTable, TellsAFaultInEvenFigures) {
  study::CheckRecord check = sampleCheck();
  check.judgements = {test::sampleJudgement(study::GateVerdict::failed, 0.123456789, 0.12345)};
  const std::string text = checkTable(check, false);
  EXPECT_THAT(text, HasSubstr("≤ 0.12345000, camera"));
  EXPECT_THAT(text, HasSubstr("0.12345679, too large by\n    0.00000679"));
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
  EXPECT_THAT(text, HasSubstr("0.1235 to\n    1.2346"));
}

TEST(CheckTable, FitsATerminalWhateverTheLimit) {
  study::CheckRecord check = sampleCheck();
  check.judgements.at(0).gate.maximum = 1e308;
  const std::string text = checkTable(check, false);
  EXPECT_THAT(text, HasSubstr("≤ 1e+308  +1.000e+308  pass"));
  for (const std::string& line : test::linesOf(text)) EXPECT_LE(displayWidth(line), 100U);
}

TEST(CheckTable, HasColoursOnlyWhereTheyAreWanted) {
  EXPECT_THAT(checkTable(sampleCheck(), true), HasSubstr("\x1b[31mfailed\x1b[0m"));
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
