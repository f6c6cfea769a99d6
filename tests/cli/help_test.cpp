#include <gmock/gmock.h>
#include <CLI/CLI.hpp>

#include <array>
#include <cstdio>
#include <fstream>
#include <memory>

#include "cli/command_line.h"

namespace gnomon::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// A program with one command, whose texts hold what a formatter would take for its own.
class Help : public ::testing::Test {
 protected:
  Help() {
    app.add_flag("--loud", loud, "Say more");
    CLI::App* measure = app.add_subcommand("measure", "Measure what is there");
    measure->add_option("FILE", file, "A file")->required()->type_name("FILE…");
    measure->add_option("--most", most, "Largest\n.value \\ of it")
        ->capture_default_str()
        ->type_name("N");
    measure->footer("\nExample:\n  sundial measure a.txt\n'quoted");
  }
  CLI::App app{"Measures shadows", "sundial"};
  bool loud = false;
  std::string file;
  int most = 7;
};

TEST_F(Help, ManualPageHasEveryCommandAndOption) {
  const std::string page = manualPage(app, "1.2");
  EXPECT_THAT(page, HasSubstr(".SH NAME\nsundial \\- Measures shadows\n"));
  EXPECT_THAT(page, HasSubstr("\"Gnomon 1.2\""));
  EXPECT_THAT(page, HasSubstr(".TP\n.B \\-\\-loud\nSay more\n"));
  EXPECT_THAT(page, HasSubstr(".SS measure\nMeasure what is there\n"));
  EXPECT_THAT(page, HasSubstr(".B FILE FILE…\nA file\n"));
  EXPECT_THAT(page, HasSubstr(".B \\-\\-most N\n"));
  EXPECT_THAT(page, HasSubstr("(default: 7)\n"));
}

/// Of a line that begins with `.` or `'` the formatter would show nothing.
TEST_F(Help, ManualPageHoldsTextAsText) {
  const std::string page = manualPage(app, "1.2");
  EXPECT_THAT(page, HasSubstr("Largest\n\\&.value \\e of it"));
  EXPECT_THAT(page, HasSubstr(".nf\nExample:\n  sundial measure a.txt\n\\&'quoted\n.fi\n"));
  EXPECT_THAT(page, Not(HasSubstr("\n.value")));
}

}  // namespace
}  // namespace gnomon::cli
