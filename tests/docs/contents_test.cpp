#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "docs/pages.h"
#include "render/method.h"
#include "render/shared_names.h"
#include "study/record/result_metrics.h"
#include "study/spec/study_file.h"
#include "support/temporary_folder.h"
#include "truth/shadow_tracer.h"

// What the manual says is what the program has: its figures, its lists and its examples.

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;

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
  for (const std::string& line : manualPage("code.md").lines) text += line + "\n";
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
  std::ifstream file(projectFolder() / "results/figure8/summary.json");
  const auto summary = nlohmann::json::parse(file);
  const DocPage readme = readPage(projectFolder() / "README.md");
  const std::string flips = percent(summary["truth"]["uncertainty"]);
  const auto saysSo = [&](const std::string& line) {
    return line.find("truth changes on " + flips + " % of the pixels") != std::string::npos;
  };
  EXPECT_TRUE(std::any_of(readme.lines.begin(), readme.lines.end(), saysSo)) << flips;
}

}  // namespace
}  // namespace gnomon::test
