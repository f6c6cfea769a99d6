#include <gmock/gmock.h>

#include <map>
#include <regex>

#include "report/paper_files.h"
#include "report/sample_record.h"
#include "report/tables/latex_table.h"
#include "report/tables/ranked_table.h"
#include "report/text/number_text.h"
#include "study/judge/ranking.h"

namespace gnomon::report {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::MatchesRegex;
using ::testing::Not;
using ::testing::SizeIs;

/// The macros of a file, by their names; every line has to be one.
std::map<std::string, std::string> macrosOf(const std::string& text) {
  static const std::regex line(R"(\\newcommand\{\\([A-Za-z]+)\}\{(.*)\}% [^\n]*)");
  std::map<std::string, std::string> macros;
  std::istringstream lines(text);
  for (std::string one; std::getline(lines, one);) {
    std::smatch match;
    const bool isMacro = std::regex_match(one, match, line);
    EXPECT_TRUE(isMacro) << one;
    const bool isNew = macros.emplace(match[1], match[2]).second;
    EXPECT_TRUE(isNew) << one;
  }
  return macros;
}

std::map<std::string, std::string> macrosOf(const study::StudyRecord& record) {
  return macrosOf(numbersTex(record, study::rankMethods(record)));
}

TEST(LatexName, HasLettersAlone) {
  EXPECT_EQ(latexName("onoue-2004"), "OnoueTwoZeroZeroFour");
  EXPECT_EQ(latexName("figure8"), "FigureEight");
  EXPECT_EQ(latexName("BER, 95 %"), "BERNineFive");
  EXPECT_EQ(latexName("é\\input{x}_影"), "InputX");
  EXPECT_EQ(latexName(""), "");
}

TEST(NumbersTex, HoldWhatTheTableShows) {
  const study::StudyRecord record = test::sampleRecord();
  const std::vector<study::RankedMethod> ranked = study::rankMethods(record);
  const auto macros = macrosOf(record);
  const Table table = rankedTable(record, ranked);
  std::size_t found = 0;
  for (const Row& row : table.rows) {
    for (const char* figure : {"Error", "False shadow", "False light", "IoU", "Memory"}) {
      for (std::size_t i = 0; i < table.columns.size(); ++i) {
        if (table.columns[i].name != figure) continue;
        const std::string name = "gnomonSample" + latexName(nameOf(table, row)) + latexName(figure);
        EXPECT_EQ(macros.at(name), escapeLatex(cellText(table.columns[i].quantity, row.cells[i])));
        ++found;
      }
    }
  }
  EXPECT_EQ(found, 15U);
  EXPECT_EQ(macros.at("gnomonSampleBestError"), "1.00");
  EXPECT_EQ(macros.at("gnomonSampleBest"), "best");
  EXPECT_EQ(macros.at("gnomonSampleBestRank"), "1");
  EXPECT_EQ(macros.at("gnomonSampleBestInterval"), "--") << "none was measured";
  EXPECT_EQ(macros.at("gnomonSampleUncertainty"), percentText(ranked.front().uncertainty));
  EXPECT_EQ(macros.at("gnomonSampleSamples"), "2\\,000");
  EXPECT_EQ(macros.at("gnomonSamplePrevalence"), "25.00");
  EXPECT_EQ(macros.at("gnomonSampleLights"), "2");
  EXPECT_EQ(macros.at("gnomonSampleView"), "camera");
  EXPECT_FALSE(macros.contains("gnomonSampleLight")) << "there are two";
}

TEST(NumbersTex, HoldNoTimes) {
  study::StudyRecord record = test::sampleRecord();
  const std::string before = numbersTex(record, study::rankMethods(record));
  record.cost[0].frameMs = 77.77;
  record.timings = {{"truth", 99}};
  EXPECT_EQ(numbersTex(record, study::rankMethods(record)), before);
}

TEST(NumbersTex, StaysWellFormedWhateverTheNames) {
  study::StudyRecord record = test::sampleRecord();
  record.name = "end 1\n}\\input{x}";
  for (study::ResultRecord& row : record.results) {
    row.method = row.method == "best" ? "a-b" : row.method == "close" ? "a b}%\\" : "影\n";
  }
  record.methods = {{"a-b", "x", "", ""}, {"a b}%\\", "y", "", ""}, {"影\n", "z", "", ""}};
  const auto macros = macrosOf(record);
  EXPECT_EQ(macros.at("gnomonEndOneInputXABError"), "1.00");
  EXPECT_EQ(macros.at("gnomonEndOneInputXABErrorX"), "1.20") << "another method of these letters";
  for (const auto& [name, text] : macros) {
    EXPECT_THAT(text, Not(MatchesRegex(".*[^\\]%.*"))) << name;
  }
}

Table table() {
  const study::StudyRecord record = test::sampleRecord();
  return rankedTable(record, study::rankMethods(record));
}

std::vector<std::string> headsOf(const Table& of, Readers reader) {
  std::vector<std::string> heads;
  for (const std::size_t i : columnsFor(of, reader)) heads.push_back(heading(of.columns[i]));
  return heads;
}

TEST(PaperTable, HasTheChosenColumnsInItsOwnOrder) {
  EXPECT_THAT(headsOf(table(), inColumn),
              ElementsAre("Method", "Error", "95 %", "False shadow", "False light", "Memory, MB"));
  const Table chosen = withColumns(table(), {"frame_ms", "iou", "interval"});
  for (const Readers reader : {inColumn, onPaper}) {
    EXPECT_THAT(headsOf(chosen, reader), ElementsAre("Method", "95 %", "IoU", "Frame, ms"));
  }
  EXPECT_EQ(headsOf(chosen, asData), headsOf(table(), asData));
  EXPECT_EQ(headsOf(withColumns(table(), {"median"}), inColumn), headsOf(table(), inColumn))
      << "a column of other tables";
}

TEST(PaperTable, KnowsTheColumnsOfStudiesAndSuites) {
  EXPECT_THAT(paperColumnKeys(), IsSupersetOf({"error_rate", "interval", "false_shadow", "bytes",
                                               "mean", "percentile95", "ranks"}));
}

TEST(PaperTable, HasTheChosenRowsInItsOwnOrder) {
  const Table chosen = withRows(table(), {"close", "best", "nosuch"});
  ASSERT_THAT(chosen.rows, SizeIs(2));
  EXPECT_EQ(nameOf(chosen, chosen.rows[0]), "best");
  EXPECT_THAT(withRows(table(), {"nosuch"}).rows, SizeIs(3));
  EXPECT_THAT(latexTabular(chosen), Not(HasSubstr("rough")));
}

TEST(ChosenMethods, AreAllOfASweepsTable) {
  study::SweepRecord sweep;
  sweep.steps = {test::sampleRecord()};
  const study::StudyRecord chosen = withMethods(sweep, {"close"}).steps.at(0);
  ASSERT_THAT(chosen.methods, SizeIs(1));
  EXPECT_THAT(chosen.cost, SizeIs(1));
  for (const study::ResultRecord& row : chosen.results) EXPECT_EQ(row.method, "close");
  EXPECT_EQ(chosen.truth.flips.size(), sweep.steps[0].truth.flips.size());
  EXPECT_THAT(withMethods(sweep, {"nosuch"}).steps.at(0).methods, SizeIs(3));
}

}  // namespace
}  // namespace gnomon::report
