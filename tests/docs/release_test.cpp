#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>

#include "docs/pages.h"

// What a release names: one version everywhere, and the checksums of its scenes.

namespace gnomon::test {
namespace {

/// What a pattern's group has found in a file of the project; empty for nothing.
std::string foundIn(const std::string& file, const std::string& pattern) {
  std::ifstream stream(projectFolder() / file);
  std::ostringstream text;
  text << stream.rdbuf();
  std::smatch match;
  const std::string content = text.str();
  return std::regex_search(content, match, std::regex(pattern)) ? match[1].str() : "";
}

TEST(Release, HasOneVersion) {
  const std::string version = foundIn("CMakeLists.txt", R"(project\(Gnomon VERSION ([0-9.]+))");
  ASSERT_FALSE(version.empty());
  EXPECT_EQ(foundIn("CITATION.cff", R"(\nversion: ([0-9.]+)\n)"), version);
  EXPECT_EQ(foundIn("codemeta.json", R"x("version": "([0-9.]+)")x"), version);
  EXPECT_EQ(foundIn("pyproject.toml", R"x(\nversion = "([0-9.]+)")x"), version);
  EXPECT_EQ(foundIn("CHANGELOG.md", R"(\n## ([0-9.]+)\n)"), version) << "the newest that is there";
  EXPECT_EQ(foundIn("action.yml", R"(gnomon@v([0-9.]+)\n)"), version);
  EXPECT_EQ(foundIn("scenes/starter/.github/workflows/shadows.yml", R"(gnomon@v([0-9.]+) )"),
            version);
}

bool succeeds(const std::string& command) {
  return std::system(command.c_str()) == 0;
}

TEST(Release, HasTheChecksumsOfItsScenes) {
  EXPECT_TRUE(succeeds("'" GNOMON_PROJECT "/scenes/checksums'"))
      << "scenes/checksums --write writes them anew";
}

/// A control, in a copy: a changed file, and one that is new, are found.
TEST(Release, ChecksumsFindAChange) {
  const std::string copy = ::testing::TempDir() + "/scenes";
  ASSERT_TRUE(
      succeeds("rm -rf '" + copy + "' && cp -r '" GNOMON_PROJECT "/scenes' '" + copy + "'"));
  const std::string check = "'" + copy + "/checksums' >/dev/null 2>&1";
  EXPECT_TRUE(succeeds(check));
  std::ofstream(copy + "/figure8.toml", std::ios::app) << "\n";
  EXPECT_FALSE(succeeds(check));
  EXPECT_TRUE(succeeds("'" + copy + "/checksums' --write") && succeeds(check));
  std::ofstream(copy + "/new.toml") << "\n";
  EXPECT_FALSE(succeeds(check));
}

}  // namespace
}  // namespace gnomon::test
