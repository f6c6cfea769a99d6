#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>

#include "docs/pages.h"
#include "render/method.h"
#include "render/shared_names.h"
#include "study/record/cases.h"
#include "study/spec/study_file.h"
#include "study/spec/suite/drawn_suite.h"
#include "support/temporary_folder.h"
#include "truth/shadow_tracer.h"

// What the manual says is what the program has: its figures, its lists and its examples.
// The figures in the tables of the manual are those of the committed files.
// A suite never changes: the manual's hashes of the public seeds are those of the scenes that are
// drawn.
// What a release names: one version everywhere, and the checksums of its scenes.

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// The names in the first cell of a row of a table, without a function's arguments.
std::vector<std::string> rowNames(const std::string& line) {
  if (!line.starts_with("| `")) return {};
  std::vector<std::string> names = codeOf(line.substr(0, line.find(" | ")));
  for (std::string& name : names) name = name.substr(0, name.find('('));
  return names;
}

std::set<std::string> rowNamesOf(const DocPage& page) {
  std::set<std::string> names;
  for (const std::string& line : page.lines) {
    for (std::string& name : rowNames(line)) names.insert(std::move(name));
  }
  return names;
}

// ---- the reference of a method's functions

/// The names of each section, by the declaration that the section says it needs.
std::map<std::string, std::set<std::string>> referenceByDeclaration() {
  std::map<std::string, std::set<std::string>> sections;
  std::string declaration;
  for (const std::string& line : manualPage("method-reference.md").lines) {
    if (line.starts_with("## ")) declaration = "";
    if (line.starts_with("Needs `")) {
      declaration = "";
      for (const std::string& code : codeOf(line.substr(0, line.find("`.") + 1))) {
        declaration += (declaration.empty() ? "" : " or ") + code;
      }
    }
    for (std::string& name : rowNames(line)) sections[declaration].insert(std::move(name));
  }
  return sections;
}

TEST(MethodReference, HoldsEveryNameUnderItsDeclarationAndNoOther) {
  std::map<std::string, std::set<std::string>> shared;
  for (const render::SharedName& name : render::sharedNames(render::shaderFolder())) {
    std::string declaration;
    for (const std::string& define : name.defines) {
      declaration += (declaration.empty() ? "" : " or ") + render::declarationFor(define);
    }
    shared[declaration].insert(name.name);
  }
  EXPECT_EQ(referenceByDeclaration(), shared);
}

// ---- lists

TEST(Manual, ListsEveryMethod) {
  const std::set<std::string> listed = rowNamesOf(manualPage("methods.md"));
  for (const std::string& name : render::methodNames(render::shaderFolder()))
    EXPECT_TRUE(listed.contains(name)) << name;
}

TEST(Manual, ListsEveryMetric) {
  std::set<std::string> listed;
  for (const std::string& line : manualPage("metrics.md").lines) {
    std::string last;
    for (const std::string& name : rowNames(line)) {
      // `boundary_iou_1`, `_2`: an ending replaces the one before it.
      const bool isEnding = name.starts_with("_");
      if (!isEnding) last = name;
      listed.insert(isEnding ? last.substr(0, last.rfind('_')) + name : name);
    }
  }
  for (const std::string& name : compare::namesOf(compare::allMetrics())) {
    EXPECT_TRUE(listed.contains(name)) << name;
  }
}

TEST(Manual, ListsEveryRegion) {
  const std::set<std::string> listed = rowNamesOf(manualPage("metrics.md"));
  for (const truth::Region region : truth::reportedRegions) {
    EXPECT_TRUE(listed.contains(std::string(truth::regionName(region))))
        << truth::regionName(region);
  }
}

/// Every component, as it stands in the build, and every folder of the program.
TEST(Manual, NamesEveryFolderOfTheCode) {
  std::string text;
  for (const std::string& line : readPage(projectFolder() / "CONTRIBUTING.md").lines)
    text += line + "\n";
  std::size_t folders = 0;
  for (const char* place : {"validate", "validate/study", "validate/report"}) {
    for (const auto& entry : fs::directory_iterator(projectFolder() / place)) {
      if (!entry.is_directory()) continue;
      const std::string name = entry.path().filename().string() + "/";
      const auto isNamed = [&](const char* before) {
        return text.find(before + name) != std::string::npos;
      };
      EXPECT_TRUE(isNamed("/") || isNamed("`")) << place << ": " << name;
      ++folders;
    }
  }
  EXPECT_GT(folders, 20U);
}

/// One reads it: the words of all its pages together, with the README. The bars and rules of tables
/// are no words.
TEST(Manual, IsShort) {
  std::vector<fs::path> pages = {projectFolder() / "README.md"};
  for (const auto& entry : fs::directory_iterator(projectFolder() / "docs")) {
    if (entry.path().extension() == ".md") pages.push_back(entry.path());
  }
  std::size_t words = 0;
  for (const fs::path& page : pages) {
    std::ifstream text(page);
    for (std::string word; text >> word;) {
      if (word.find_first_not_of("|-:") != std::string::npos) ++words;
    }
  }
  EXPECT_GT(words, 10'000U);
  EXPECT_LE(words, 22'000U);
}

// ---- examples

class Example : public TemporaryFolder {
 protected:
  /// The first block of a page in a language, as a file.
  [[nodiscard]] fs::path written(const std::string& page, const std::string& language,
                                 const std::string& name) const {
    for (const CodeBlock& block : manualPage(page).blocks) {
      if (block.language != language) continue;
      std::ofstream(file(name)) << block.text;
      return file(name);
    }
    ADD_FAILURE() << page << ": no block of " << language;
    return {};
  }
};

TEST_F(Example, StudyIsOne) {
  const study::StudySpec study =
      study::readStudy(written("writing-a-study.md", "toml", "study.toml"));
  EXPECT_EQ(study.name, "my-study");
  EXPECT_EQ(study.lights.size(), 2U);
  EXPECT_EQ(study.thresholds.size(), 1U);
}

TEST_F(Example, StudyOfOnesOwnMeshIsOne) {
  const fs::path scenes = projectFolder() / "scenes";
  fs::copy_file(scenes / "meshes/spot_control_mesh.obj", file("my-mesh.obj"));
  fs::copy_file(scenes / "heights/jacksboro_fault_dem.png", file("my-heights.png"));
  const study::StudySpec study = study::readStudy(written("your-own-mesh.md", "toml", "mine.toml"));
  EXPECT_EQ(study.name, "mine");
  EXPECT_EQ(study.methods.size(), 4U);
}

TEST_F(Example, MethodIsOne) {
  const render::Method method =
      render::readMethod(written("adding-a-method.md", "glsl", "biased.glsl"));
  EXPECT_TRUE(method.tables.horizon);
  EXPECT_EQ(method.parameters.count("bias"), 1U);
}

// ---- figures

/// A number with two decimals, as tables print percent.
std::string percent(double share) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2f", 100 * share);
  return text.data();
}

/// The sentence below the README's table; results/tables.py has the table.
TEST(Readme, SaysHowCertainTheTruthIs) {
  std::ifstream file(projectFolder() / "results/figure8/table.csv");
  std::string header;
  std::string row;
  std::getline(file, header);
  std::getline(file, row);
  const std::string columns = header.substr(0, header.find("uncertainty"));
  std::istringstream cells(row);
  std::string uncertainty;
  for (auto n = std::count(columns.begin(), columns.end(), ','); n >= 0; --n) {
    std::getline(cells, uncertainty, ',');
  }
  const DocPage readme = readPage(projectFolder() / "README.md");
  const std::string flips = percent(std::stod(uncertainty));
  const auto saysSo = [&](const std::string& line) {
    return line.find("truth changes on " + flips + " % of the pixels") != std::string::npos;
  };
  EXPECT_TRUE(std::any_of(readme.lines.begin(), readme.lines.end(), saysSo)) << flips;
}

std::string textOf(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class Tables : public TemporaryFolder {
 protected:
  /// A project of the committed pages and results, whose pages may be written.
  void SetUp() override {
    fs::create_directories(file("results"));
    for (const auto& entry : fs::directory_iterator(projectFolder() / "results")) {
      const fs::path copy = file("results") / entry.path().filename();
      if (entry.is_directory()) {
        fs::create_directory_symlink(entry.path(), copy);
      } else {
        fs::copy_file(entry.path(), copy);
      }
    }
    fs::copy(projectFolder() / "docs", file("docs"));
    fs::copy_file(projectFolder() / "README.md", file("README.md"));
  }
  /// Runs the script; what it prints is in `printed`.
  [[nodiscard]] bool succeeds(const std::string& options) {
    const std::string command = "python3 " + file("results/tables.py").string() + options + " > " +
                                file("printed.txt").string() + " 2>&1";
    const bool isDone = std::system(command.c_str()) == 0;  // NOLINT(cert-env33-c)
    printed = textOf(file("printed.txt"));
    return isDone;
  }

  std::string printed;
};

TEST_F(Tables, AreThoseOfTheFiles) {
  EXPECT_TRUE(succeeds(" --check")) << printed;
  EXPECT_THAT(printed, HasSubstr("all tables as the files have them"));
}

TEST_F(Tables, ThatWereChangedAreNamedAndWrittenAnew) {
  const std::vector<std::pair<std::string, std::string>> rows = {
      {"README.md", "| `unshadowed`: bump mapping alone, the control | "},
      {"results/README.md", "| `max-forsyth` | "},
      {"docs/settings.md", "| `relief-march` | steps | 64 | "},
      {"docs/which-method.md", "| `shadow-map`, 9 | "},
  };
  std::map<std::string, std::string> texts;
  for (const auto& [page, row] : rows) {
    std::string text = texts[page] = textOf(file(page));
    const std::size_t at = text.find(row);
    ASSERT_NE(at, std::string::npos) << page;
    const std::size_t digit = text.find_last_of("0123456789", text.find('\n', at));
    text[digit] = text[digit] == '9' ? '8' : '9';
    std::ofstream(file(page)) << text;
  }
  EXPECT_FALSE(succeeds(" --check"));
  for (const auto& [page, row] : rows) {
    EXPECT_THAT(printed, HasSubstr(std::string(page).append("\n  has  ").append(row)));
  }
  EXPECT_THAT(printed, HasSubstr("4 rows differ"));
  EXPECT_TRUE(succeeds("")) << printed;
  for (const auto& [page, text] : texts) EXPECT_EQ(textOf(file(page)), text) << page;
}

/// What results/ keeps of a run is found to be the same, or not.
TEST_F(Tables, AndMasksOfARunAreComparedByTheirHashes) {
  const auto write = [&](const std::string& name, const std::string& text) {
    fs::create_directories(file("runs/small/" + name).parent_path());
    std::ofstream(file("runs/small/" + name)) << text;
  };
  const auto runs = [&](const std::string& task) {
    const std::string command = "python3 " + file("results/kept.py").string() + " " + task + " " +
                                file("runs").string() + " small > " + file("printed.txt").string() +
                                " 2>&1";
    const bool isDone = std::system(command.c_str()) == 0;  // NOLINT(cert-env33-c)
    printed = textOf(file("printed.txt"));
    return isDone;
  };
  write("table.csv", "method,error_rate,frame_ms\n\"a, b\",0.25,3\n");
  write("metrics.csv", "method,tp\na,7\n");
  write("masks/truth.png", "grey");
  ASSERT_TRUE(runs("keep")) << printed;
  EXPECT_TRUE(fs::exists(file("results/small/table.csv")));
  EXPECT_FALSE(fs::exists(file("results/small/metrics.csv")));
  EXPECT_TRUE(runs("compare")) << printed;
  // A frame's time is the clock's.
  write("table.csv", "method,error_rate,frame_ms\n\"a, b\",0.25,4\n");
  EXPECT_TRUE(runs("compare")) << printed;
  write("table.csv", "method,error_rate,frame_ms\n\"a, b\",0.26,4\n");
  EXPECT_FALSE(runs("compare"));
  EXPECT_THAT(printed, HasSubstr("differs: table.csv"));
  write("table.csv", "method,error_rate,frame_ms\n\"a, b\",0.25,4\n");
  write("masks/truth.png", "gray");
  EXPECT_FALSE(runs("compare"));
  EXPECT_THAT(printed, HasSubstr("differs: masks"));
  write("masks/truth.png", "grey");
  fs::remove(file("runs/small/metrics.csv"));
  EXPECT_FALSE(runs("compare"));
  EXPECT_THAT(printed, HasSubstr("differs: metrics.csv"));
}

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
