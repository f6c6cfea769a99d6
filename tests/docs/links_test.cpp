#include <gtest/gtest.h>

#include <regex>

#include "docs/pages.h"

// Every relative link of README.md, docs/, results/ and scenes/ leads to a file that is there, and
// its anchor to a heading of that file. Pictures are links, too.

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;

/// The targets of all links of a page, `[text](target)` and `![text](target)`.
std::vector<std::string> linksOf(const DocPage& page) {
  static const std::regex link(R"(\]\(([^()\s]+)\))");
  std::vector<std::string> targets;
  for (const std::string& line : page.lines) {
    for (std::sregex_iterator match(line.begin(), line.end(), link), end; match != end; ++match) {
      targets.push_back((*match)[1]);
    }
  }
  return targets;
}

/// What is wrong with a link; empty for nothing.
std::string faultOf(const DocPage& page, const std::string& target) {
  if (target.starts_with("https://")) return "";
  const std::size_t hash = target.find('#');
  const std::string name = target.substr(0, hash);
  const fs::path file = name.empty() ? page.file : page.file.parent_path() / name;
  if (!fs::exists(file)) return "no such file";
  if (hash == std::string::npos) return "";
  return anchorsOf(readPage(file)).contains(target.substr(hash + 1)) ? "" : "no such heading";
}

TEST(Links, LeadSomewhere) {
  std::size_t links = 0;
  for (const DocPage& page : allPages()) {
    for (const std::string& target : linksOf(page)) {
      EXPECT_EQ(faultOf(page, target), "") << page.file.string() << ": " << target;
      ++links;
    }
  }
  EXPECT_GT(links, 100U);
}

TEST(Links, AreFoundBroken) {
  const DocPage page = manualPage("README.md");
  EXPECT_EQ(faultOf(page, "metrics.md#regions"), "");
  EXPECT_EQ(faultOf(page, "#commands"), "");
  EXPECT_EQ(faultOf(page, "metrics.md#no-heading"), "no such heading");
  EXPECT_EQ(faultOf(page, "no-page.md"), "no such file");
  EXPECT_EQ(faultOf(page, "../results/no-picture.png"), "no such file");
}

TEST(Links, IndexNamesEveryPageOfTheManual) {
  const std::vector<std::string> links = linksOf(manualPage("README.md"));
  for (const auto& entry : fs::directory_iterator(projectFolder() / "docs")) {
    const std::string name = entry.path().filename().string();
    if (!name.ends_with(".md") || name == "README.md") continue;
    EXPECT_NE(std::find(links.begin(), links.end(), name), links.end()) << name;
  }
}

TEST(Links, ReadmeIsOnePage) {
  EXPECT_LE(readPage(projectFolder() / "README.md").lines.size(), 80U);
}

}  // namespace
}  // namespace gnomon::test
