#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <array>
#include <limits>
#include <regex>
#include <set>
#include <sstream>

#include "common/error.h"
#include "report/json/summary_json.h"
#include "report/page/html_page.h"
#include "report/page/report_html.h"
#include "report/sample_record.h"
#include "report/tables/case_tables.h"
#include "report/tables/confidence.h"
#include "report/tables/latex_table.h"
#include "report/tables/ranked_table.h"
#include "report/tables/table.h"
#include "report/terminal_page.h"
#include "report/terminal_report.h"

// An error budget in every kind of report.
// Confidence, differences and bins in every kind of report.

namespace gnomon::report {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

study::BudgetShare share(double value, bool distinguishable = true) {
  return {value, compare::Interval{value - 0.001, value + 0.002}, "",
          distinguishable ? study::DifferenceVerdict::worse
                          : study::DifferenceVerdict::notDistinguishable};
}

/// 5 % wrong: forward +3, -1, +0.5, left 0.5 and 2; backward moves 0.5 from the first to the third.
study::BudgetRecord budgetOf(const std::string& method, const std::string& light) {
  study::BudgetRecord budget;
  budget.method = method;
  budget.view = "atlas";
  budget.light = light;
  budget.uncertainty = 0.0004;
  budget.blocks = 64;
  budget.total = share(0.05);
  budget.causes = {{"map <interpolation>", "resampled", share(0.03), share(0.025)},
                   {"bits", "float & all", share(-0.01), share(-0.01)},
                   {"formula", "", share(0.005, false), share(0.01)}};
  budget.rest = {
      {"global", share(0)}, {"distant", share(0.005)}, {"seam", share(0)}, {"other", share(0.02)}};
  budget.forward = {
      {0.05, 0.03, 0.02}, {0.02, 0.01, 0.01}, {0.03, 0.02, 0.01}, {0.025, 0.02, 0.005}};
  budget.backward = {
      {0.05, 0.03, 0.02}, {0.04, 0.03, 0.01}, {0.05, 0.04, 0.01}, {0.025, 0.02, 0.005}};
  return budget;
}

study::StudyRecord recordWithBudgets() {
  study::StudyRecord made = test::sampleRecord();
  for (const char* light : {"all", "low", "high"}) {
    made.budgets.push_back(budgetOf("close", light));
    made.budgets.push_back(budgetOf("rough, \"old\"", light));
  }
  return made;
}

TEST(BudgetFiles, CsvHasARowAPart) {
  const std::string csv = csvTable(budgetPartsTable(recordWithBudgets()));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 6 * 8);
  EXPECT_THAT(csv, HasSubstr("\nclose,atlas,all,total,0.05,0.049,0.052000000000000005,1,0.05,"));
  EXPECT_THAT(csv, HasSubstr("\n\"rough, \"\"old\"\"\",atlas,low,formula,0.005,"));
  EXPECT_THAT(csv, HasSubstr(",0,0.01,0.009000000000000001,0.012,1,0.0004\n"));
}

study::DifferenceRecord difference(const std::string& first, const std::string& second,
                                   double value, std::optional<compare::Interval> interval,
                                   study::DifferenceVerdict verdict) {
  return {"camera", "all",  first, second, value, interval, interval ? "" : "too few differ",
          0.003,    verdict};
}

/// "rough" 10 %, "close" 1.2 %, "best" 1 %.
study::StudyRecord recordOfThree() {
  study::StudyRecord made = test::sampleRecord();
  made.confidence = {
      {"rough, \"old\"", "camera", "all", 0.1, compare::Interval{0.08, 0.13}, "", 25, 40},
      {"rough, \"old\"", "camera", "elevation 15°", 0.1, compare::Interval{0.07, 0.14}, "", 25, 40},
      {"close", "camera", "all", 0.012, compare::Interval{0.009, 0.016}, "", 25, 40},
      {"best", "camera", "all", 0.01, std::nullopt, "too few blocks", 25, 40}};
  made.differences = {
      difference("rough, \"old\"", "close", 0.088, compare::Interval{0.07, 0.11},
                 study::DifferenceVerdict::worse),
      difference("rough, \"old\"", "best", 0.09, compare::Interval{0.072, 0.115},
                 study::DifferenceVerdict::worse),
      difference("close", "best", 0.02, std::nullopt, study::DifferenceVerdict::noInterval)};
  made.bins = {{"best", "camera", "all", "elevation", {}, 10.0, {1, 2, 3, 4, 10}},
               {"best", "camera", "all", "elevation", 10.0, {}, {5, 0, 0, 5, 10}}};
  return made;
}

TEST(ConfidenceText, RanksWhatAllLightsTogetherGive) {
  const std::vector<study::ConfidenceRecord> ranked = rankedIn(recordOfThree(), "camera");
  ASSERT_EQ(ranked.size(), 3U);
  EXPECT_EQ(ranked[0].method, "best");
  EXPECT_EQ(ranked[2].light, "all");
  EXPECT_EQ(confidenceViews(recordOfThree()), std::vector<std::string>{"camera"});
  EXPECT_TRUE(rankedIn(recordOfThree(), "atlas").empty());
}

/// One record with every answer: each format has the same sign of each.
TEST(Signs, AreTheSameInEveryFormat) {
  study::StudyRecord record = test::sampleRecord(1);
  const auto add = [&](const std::string& method, double wrong) {
    record.results.push_back(
        test::result(method, "elevation 15°", "camera", "all", test::countsOf(1000, wrong, 0)));
  };
  add("same", 10);
  add("unknown", 300);
  test::addDifferences(record, 0.001);
  for (study::DifferenceRecord& row : record.differences) {
    const auto isOf = [&](const char* method) {
      return row.first == method || row.second == method;
    };
    if (!isOf("best")) continue;
    if (isOf("same")) row.verdict = study::DifferenceVerdict::equal;
    if (isOf("close")) row.interval = compare::Interval{-0.1, 0.1};
    if (isOf("unknown")) row.reason = "too few blocks";
    if (isOf("unknown")) row.interval.reset();
    if (!isOf("same")) row.verdict = study::distinguish(study::estimateOf(row));
  }
  const std::vector<study::RankedMethod> ranked = study::rankMethods(record);
  const Table table = rankedTable(record, ranked);
  const std::string note = "? No interval of the difference of “unknown”: too few blocks.";
  EXPECT_EQ(table.notes, std::vector<std::string>{note});
  const std::string markdown = markdownTable(table);
  const std::string latex = latexTabular(table, {onPaper, 500, 9});
  const std::string page = htmlTable(table).text();
  const std::string csv = csvTable(table);
  const std::string terminal = terminalReport(record, false);
  for (const auto& [method, sign, inLatex, name] :
       {std::array{"same", " =", "=~", "equal"},
        std::array{"close", " ≈", "$\\approx$~", "not distinguishable"},
        std::array{"unknown", " ?", "?~", "no interval"}, std::array{"rough", "", "", "worse"}}) {
    EXPECT_THAT(markdown, HasSubstr(std::string("| ") + method + (*sign != 0 ? sign : ", ")));
    EXPECT_THAT(latex, HasSubstr(std::string("  ") + inLatex + method));
    EXPECT_THAT(page, HasSubstr(std::string(method) + (*sign != 0 ? sign : ", ")));
    const std::size_t row = csv.find(method);
    EXPECT_THAT(csv.substr(row, csv.find('\n', row) - row),
                HasSubstr(std::string(",") + name + ","));
  }
  EXPECT_THAT(terminal, HasSubstr(" ?\n"));
  EXPECT_THAT(terminal, HasSubstr(" =\n"));
  EXPECT_THAT(terminal, HasSubstr(" ≈\n"));
  EXPECT_THAT(terminal, HasSubstr("\n  " + note));
}

TEST(BinsCsv, HasARowABin) {
  EXPECT_EQ(csvTable(binsTable(recordOfThree())),
            "study,method,view,light,axis,low,high,samples,tp,fp,fn,tn,error_rate,false_shadow,"
            "false_light\n"
            "sample,best,camera,all,elevation,,10,10,1,2,3,4,0.5,0.2,0.3\n"
            "sample,best,camera,all,elevation,10,,10,5,0,0,5,0,0,0\n");
}

}  // namespace
}  // namespace gnomon::report
