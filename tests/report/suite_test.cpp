#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "report/plots/line_plot.h"
#include "report/suite/suite_files.h"
#include "report/suite/suite_plots.h"
#include "report/suite/suite_tables.h"
#include "report/tables/table.h"
#include "report/text/number_text.h"
#include "study/judge/suite/suite_studies.h"
#include "support/error_messages.h"
#include "support/temporary_folder.h"

namespace gnomon::report {
namespace {

using test::drawnStudies;
using ::testing::HasSubstr;
using ::testing::Not;

/// Twenty-five scenes on which m1 is always better than m0; "hard <scene>" is the hardest.
std::vector<study::StudyMeans> studies() {
  std::vector<study::StudyMeans> all = drawnStudies(
      25, 2,
      [](std::size_t s, std::size_t m) {
        return (m == 0 ? 0.004 : 0.002) * static_cast<double>(s + 1);
      },
      0.0005);
  all[24].title = "hard <scene>";
  for (study::StudyMeans& study : all) {
    for (const study::MethodMeans& method : study.methods) {
      study.bins.push_back({method.label, "elevation", {}, 10, {0.25, *method.errorRate / 2}});
      study.bins.push_back({method.label, "elevation", 10, {}, {0.75, *method.errorRate / 2}});
    }
  }
  return all;
}

study::SuiteStatistics statistics() {
  return study::suiteStatistics("drawn", studies());
}

std::vector<DrawnPlot> drawn(const study::SuiteStatistics& of) {
  std::vector<PlotSheet> sheets = sheetsOf(suitePlots(of, plottedMethods(of)));
  const bool isRanked = std::any_of(of.methods.begin(), of.methods.end(),
                                    [](const auto& method) { return method.rank.has_value(); });
  if (isRanked) sheets.push_back(suiteWinsPlot(of));
  return drawPlots(std::move(sheets), nullptr);
}

TEST(SuiteHtml, SaysWhatWasFound) {
  const study::SuiteStatistics found = statistics();
  const std::string html = suiteHtml(found, drawn(found), "gnomon run a & b").text();
  for (const char* part : {"drawn: 2 methods over 25 scenes",
                           "<b>m1</b> has the fewest wrong samples: <b>2.60&#8239;%",
                           "distinguishable from every other", "Who beats whom",
                           "hard &lt;scene&gt;", "href=\"scene-024/report.html\"", "below 10",
                           "gnomon run a &amp; b", "src=\"data:image/svg+xml;base64,"}) {
    EXPECT_THAT(html, HasSubstr(part));
  }
  for (const char* fetch : {"http://", "https://", "<link", "<script src", "@import", "url("}) {
    EXPECT_THAT(html, Not(HasSubstr(fetch)));
  }
}

TEST(SuiteHtml, WithoutAMethodOnEveryScene) {
  std::vector<study::StudyMeans> some = studies();
  some[0].methods.clear();
  const study::SuiteStatistics found = study::suiteStatistics("drawn", some);
  const std::string html = suiteHtml(found, drawn(found), "").text();
  EXPECT_THAT(html, HasSubstr("No method was measured on every scene"));
  EXPECT_THAT(html, HasSubstr("on 24 of 25 scenes: no rank"));
  EXPECT_THAT(html, Not(HasSubstr("Who beats whom")));
}

TEST(SuiteJson, HoldsWhatThePageShows) {
  const study::SuiteStatistics found = statistics();
  const auto json = nlohmann::json::parse(suiteJson(found, "gnomon run"));
  EXPECT_EQ(json["schema"], "gnomon-suite/1");
  EXPECT_EQ(json["suite"], "drawn");
  EXPECT_EQ(json["methods"][0]["label"], "m1");
  EXPECT_EQ(json["methods"][0]["rank"], 1);
  EXPECT_EQ(json["methods"][0]["rank_stability"], 1);
  EXPECT_EQ(json["methods"][0]["worst_scene"], "scene-024");
  EXPECT_EQ(json["comparisons"], 1);
  ASSERT_EQ(json["pairs"].size(), 1U);
  EXPECT_EQ(json["pairs"][0]["verdict"], "better");
  EXPECT_EQ(json["pairs"][0]["win_probability"], 1);
  EXPECT_EQ(json["bins"].size(), 4U);
  EXPECT_EQ(json["scenes"][0]["name"], "scene-024");
  EXPECT_EQ(json["results"].size(), 50U);
  study::SuiteStatistics broken = found;
  broken.methods[0].spread.mean = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(suiteJson(broken, ""), InternalError);
}

TEST(SuiteCsv, HasARowASceneAndMethod) {
  std::vector<study::StudyMeans> some = studies();
  some[1].methods[0].caseErrors.emplace_back();  // m0 lacks a light there
  const std::string csv = csvTable(suiteResultsTable(study::suiteStatistics("drawn", some), some));
  EXPECT_EQ(csv.substr(0, csv.find('\n')),
            "scene,method,error_rate,false_shadow,false_light,uncertainty,rank");
  EXPECT_THAT(csv, HasSubstr("\nscene-000,m0,0.004,0.001,0.003,0.0005,2\n"));
  EXPECT_THAT(csv, HasSubstr("\nscene-000,m1,0.002,0.0005,0.0015,0.0005,1\n"));
  EXPECT_THAT(csv, HasSubstr("\nscene-001,m0,,,,0.0005,\n"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 51);
}

TEST(SuiteText, IsRounded) {
  EXPECT_EQ(probabilityText(0.0004), "<0.001");
  EXPECT_EQ(probabilityText(0.0126), "0.013");
  EXPECT_EQ(rankText(2, 2), "2");
  EXPECT_EQ(rankText(1, 3), "1 to 3");
  EXPECT_EQ(binText({}, 5), "below 5");
  EXPECT_EQ(binText(5, 10), "5 to 10");
  EXPECT_EQ(binText(75, {}), "75 and more");
}

class SuiteFiles : public TemporaryFolder {};

TEST_F(SuiteFiles, AreWrittenForASuiteOnly) {
  RunFolder folder(file("out"), {"ranking.json", {}, "ranking.txt"});
  std::filesystem::create_directories(folder.path());
  std::vector<study::StudyMeans> few = studies();
  few.resize(19);
  EXPECT_FALSE(writeSuiteOf(few, "", SuiteParts::all, PaperOptions{}, folder));
  EXPECT_FALSE(folder.names("suite.html"));
  PaperOptions paper;
  paper.widths = {PaperWidth::page};
  EXPECT_TRUE(writeSuiteOf(studies(), "", SuiteParts::all, paper, folder));
  for (const char* name :
       {"suite.csv", "suite.md", "suite.html", "suite.json", "plots/suite-errors.svg",
        "plots/suite-wins.pdf", "plots/suite-bins_elevation.svg", "suite-table.tex",
        "suite-table-page.tex", "suite-numbers.tex", "figures/page/suite-errors.pdf"}) {
    EXPECT_TRUE(folder.names(name)) << name;
    EXPECT_GT(std::filesystem::file_size(folder.path() / name), 100U) << name;
  }
}

TEST_F(SuiteFiles, OfFiguresAloneLeadToNoPage) {
  RunFolder folder(file("out"), {"ranking.json", {}, "ranking.txt"});
  std::filesystem::create_directories(folder.path());
  EXPECT_TRUE(writeSuiteOf(studies(), "", SuiteParts::figures, PaperOptions{}, folder));
  EXPECT_TRUE(folder.names("suite.csv"));
  EXPECT_TRUE(folder.names("suite.json"));
  EXPECT_FALSE(folder.names("suite.html"));
  EXPECT_FALSE(folder.names("plots/suite-errors.svg"));
  std::ifstream text(folder.path() / "suite.json");
  EXPECT_TRUE(nlohmann::json::parse(text)["scenes"][0]["report"].is_null());
}

/// A list of methods and the errors of its entries on three scenes.
class SuiteSettings : public TemporaryFolder {
 protected:
  void SetUp() override {
    writeTextAtomically(file("methods.toml"), R"([[method]]
name = "plain"

[[method]]
name = "table"
bake = { azimuths = 32 }
vary = { "bake.azimuths" = [16, 64], "parameters.steps" = [0.5] }

[[method]]
name = "volume"
vary = { "base.subdivisions" = [5] }
)");
    methods_ = study::readSuiteMethods(file("methods.toml"), {});
    train_.scenes = {"one", "two", "three"};
    train_.uncertainty = {0, 0, 0};
    add("plain", {0.5, 0.5, 0.5});
    add("table", {0.3, 0.1, 0.2});
    add("table, azimuths 16", {0.4, 0.1, 0.1});
    add("table, azimuths 64", {0.1, 0.2, 0.1});
    add("table, steps 0.5", {0.1, 0.1, 0.4});
    add("volume", {{}, 0.2, 0.2});
    add("volume, subdivisions 5", {0.1, 0.2, 0.2});
  }
  void add(const std::string& label, const std::vector<std::optional<double>>& errors) {
    train_.methods.push_back(label);
    train_.errors.push_back(errors);
  }

  study::SuiteMethods methods_;
  compare::SceneTable train_;
};

TEST_F(SuiteSettings, HaveTheLeastMeanOverTheScenesOfAllTheirValues) {
  const auto tried = study::triedSettings(methods_, train_);
  ASSERT_EQ(tried.size(), 3U);
  EXPECT_EQ(tried[0].key, "bake.azimuths");
  EXPECT_EQ(tried[0].values.front().value, "32");
  EXPECT_EQ(tried[0].scenes, 3U);
  EXPECT_EQ(tried[0].best, 2U);
  EXPECT_NEAR(tried[0].values[2].mean, 0.4 / 3, 1e-15);
  // Of equal means the authors' value stays.
  EXPECT_EQ(tried[1].values.front().value, "");
  EXPECT_EQ(tried[1].best, 0U);
  // On the scene that one value lacks, no value counts.
  EXPECT_EQ(tried[2].scenes, 2U);
  EXPECT_EQ(tried[2].best, 0U);
}

TEST_F(SuiteSettings, AreReadByTheNextSuite) {
  const auto tried = study::triedSettings(methods_, train_);
  const std::string text = chosenSettingsText(methods_, tried, "suite-t, 3 scenes");
  EXPECT_THAT(text, HasSubstr("# table, bake.azimuths: 32 20.00 %, 16 20.00 %, 64 13.33 % "
                              "(chosen); 3 scenes\n"));
  writeTextAtomically(file("chosen.toml"), text);
  const auto read = study::readSuiteMethods(file("methods.toml"), file("chosen.toml"));
  ASSERT_EQ(read.chosen.size(), 1U);
  EXPECT_EQ(read.chosen[0]["label"].value<std::string>(), "table, chosen");
  EXPECT_EQ(read.chosen[0]["bake"]["azimuths"].value<int>(), 64);
  EXPECT_FALSE(read.chosen[0].contains("parameters"));
}

TEST_F(SuiteSettings, MayAllBeTheAuthors) {
  for (auto& errors : train_.errors) errors = {0.1, 0.1, 0.1};
  const auto tried = study::triedSettings(methods_, train_);
  const std::string text = chosenSettingsText(methods_, tried, "suite-t, 3 scenes");
  EXPECT_THAT(text, Not(HasSubstr("[[method]]")));
  writeTextAtomically(file("chosen.toml"), text);
  EXPECT_TRUE(study::readSuiteMethods(file("methods.toml"), file("chosen.toml")).chosen.empty());
}

TEST_F(SuiteSettings, NeedEveryEntryOfTheList) {
  train_.methods.pop_back();
  train_.errors.pop_back();
  EXPECT_THAT(messageOf<InputError>([&] { study::triedSettings(methods_, train_); }),
              HasSubstr("\"volume, subdivisions 5\" not found among the methods of these scenes"));
  add("volume, subdivisions 5", {0.1, {}, {}});
  EXPECT_THAT(messageOf<InputError>([&] { study::triedSettings(methods_, train_); }),
              HasSubstr("\"volume\": no scene has an error for every value of base.subdivisions"));
}

}  // namespace
}  // namespace gnomon::report
