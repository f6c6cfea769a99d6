#include <gtest/gtest.h>

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
  for (std::size_t bar; (bar = line.find(" |", begin)) != std::string::npos; begin = bar + 3) {
    cells.push_back(line.substr(begin, bar - begin));
  }
  return cells;
}

TEST(Suite, OfThePublicSeedsNeverChanges) {
  const SuiteSpec suite = readSuite(projectFolder() / "scenes/suite/suite-1.toml");
  const SuiteMethods methods = readSuiteMethods(projectFolder() / "scenes/suite/methods.toml", {});
  std::size_t suites = 0;
  for (const std::string& line : manualPage("suite.md").lines) {
    const std::vector<std::string> cells =
        line.starts_with("| ") ? cellsOf(line) : std::vector<std::string>();
    if (cells.size() != 4 || (cells[1] != "train" && cells[1] != "test")) continue;
    const SuiteSplit split = cells[1] == "train" ? SuiteSplit::train : SuiteSplit::test;
    const DrawnSuite drawn = drawSuite(suite, methods, split, cells[0], std::stoi(cells[2]));
    EXPECT_EQ("`" + drawn.sha256 + "`", cells[3]) << "seed " << cells[0] << ", " << cells[1];
    ++suites;
  }
  EXPECT_EQ(suites, 4U);
}

/// A control: one scene more, or one number of the file, is another suite.
TEST(Suite, ChangesWithItsFile) {
  SuiteSpec suite = readSuite(projectFolder() / "scenes/suite/suite-1.toml");
  const std::string before = drawSuite(suite, {}, SuiteSplit::test, "1", 3).sha256;
  EXPECT_EQ(drawSuite(suite, {}, SuiteSplit::test, "1", 3).sha256, before);
  EXPECT_NE(drawSuite(suite, {}, SuiteSplit::test, "1", 4).sha256, before);
  suite.triangles += 1;
  EXPECT_NE(drawSuite(suite, {}, SuiteSplit::test, "1", 3).sha256, before);
}

}  // namespace
}  // namespace gnomon::test
