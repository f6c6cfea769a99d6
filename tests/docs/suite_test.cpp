#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <string>

#include "docs/pages.h"
#include "study/spec/suite/drawn_suite.h"

// A suite never changes: the manual's hashes of the public seeds are those of the scenes that are
// drawn.

namespace gnomon::test {
namespace {

/// The cells of a row of a table.
std::vector<std::string> cellsOf(const std::string& line) {
  std::vector<std::string> cells;
  std::size_t begin = 2;
  for (std::size_t bar = 0; (bar = line.find(" |", begin)) != std::string::npos; begin = bar + 3) {
    cells.push_back(line.substr(begin, bar - begin));
  }
  return cells;
}

TEST(Suite, OfThePublicSeedsNeverChanges) {
  const study::SuiteMethods methods =
      study::readSuiteMethods(projectFolder() / "scenes/suite/methods.toml", {});
  std::size_t suites = 0;
  for (const std::string& line : manualPage("suite.md").lines) {
    const std::vector<std::string> cells =
        line.starts_with("| ") ? cellsOf(line) : std::vector<std::string>();
    if (cells.size() != 5 || (cells[2] != "train" && cells[2] != "test")) continue;
    const study::SuiteSpec suite =
        study::readSuite(projectFolder() / "scenes/suite" / (cells[0] + ".toml"));
    const study::SuiteSplit split =
        cells[2] == "train" ? study::SuiteSplit::train : study::SuiteSplit::test;
    const study::DrawnSuite drawn =
        study::drawSuite(suite, methods, split, cells[1], std::stoi(cells[3]));
    EXPECT_EQ("`" + drawn.sha256 + "`", cells[4]) << line;
    ++suites;
  }
  EXPECT_EQ(suites, 8U);
}

/// What the results say of the second seed is what `reproduce` has written.
TEST(Suite, OfASecondSeedRanksAsItsFileSays) {
  std::ifstream file(projectFolder() / "results/suite-1-second-seed/agreement.txt");
  std::string said;
  std::getline(file, said);
  std::smatch of;
  ASSERT_TRUE(std::regex_search(
      said, of,
      std::regex("τ-b ([0-9.]+) over (\\d+) methods; (\\d+) of (\\d)(\\d{3}) pairs in another "
                 "order, 0 of them")));
  std::string page;
  for (const std::string& line : readPage(projectFolder() / "results/README.md").lines) {
    page += line + " ";
  }
  EXPECT_THAT(page, ::testing::HasSubstr(fmt::format(
                        "τ-b of the two is {} over {} methods, and of the {} of {},{} pairs",
                        of.str(1), of.str(2), of.str(3), of.str(4), of.str(5))));
}

/// A control: one scene more, or one number of the file, is another suite.
TEST(Suite, ChangesWithItsFile) {
  study::SuiteSpec suite = study::readSuite(projectFolder() / "scenes/suite/suite-1.toml");
  const std::string before = study::drawSuite(suite, {}, study::SuiteSplit::test, "1", 3).sha256;
  EXPECT_EQ(study::drawSuite(suite, {}, study::SuiteSplit::test, "1", 3).sha256, before);
  EXPECT_NE(study::drawSuite(suite, {}, study::SuiteSplit::test, "1", 4).sha256, before);
  suite.triangles += 1;
  EXPECT_NE(study::drawSuite(suite, {}, study::SuiteSplit::test, "1", 3).sha256, before);
}

}  // namespace
}  // namespace gnomon::test
