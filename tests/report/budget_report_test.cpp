// An error budget in every kind of report.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "report/json/summary_json.h"
#include "report/page/budget_html.h"
#include "report/page/report_html.h"
#include "report/plots/budget_bars.h"
#include "report/sample_record.h"
#include "report/tables/budget_files.h"
#include "report/tables/terminal_table.h"
#include "report/text/budget_text.h"
#include "report/text/text_width.h"

namespace gnomon {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

BudgetShare share(double value, bool distinguishable = true) {
  return {value, Interval{value - 0.001, value + 0.002}, "", distinguishable};
}

/// 5 % wrong: forward +3, -1, +0.5, left 0.5 and 2; backward moves 0.5 from the first to the third.
BudgetRecord budgetOf(const std::string& method, const std::string& light) {
  BudgetRecord budget;
  budget.method = method;
  budget.view = "atlas";
  budget.light = light;
  budget.uncertainty = 0.0004;
  budget.blocks = 64;
  budget.total = share(0.05);
  budget.causes = {{"map <interpolation>", "resampled", share(0.03), share(0.025)},
                   {"bits", "float & all", share(-0.01), share(-0.01)},
                   {"formula", "", share(0.005, false), share(0.01)}};
  budget.distant = share(0.005);
  budget.other = share(0.02);
  budget.forward = {
      {0.05, 0.03, 0.02}, {0.02, 0.01, 0.01}, {0.03, 0.02, 0.01}, {0.025, 0.02, 0.005}};
  budget.backward = {
      {0.05, 0.03, 0.02}, {0.04, 0.03, 0.01}, {0.05, 0.04, 0.01}, {0.025, 0.02, 0.005}};
  return budget;
}

StudyRecord recordWithBudgets() {
  StudyRecord made = test::sampleRecord();
  for (const char* light : {"all", "low", "high"}) {
    made.budgets.push_back(budgetOf("close", light));
    made.budgets.push_back(budgetOf("rough, \"old\"", light));
  }
  return made;
}

TEST(BudgetText, SaysHowMuchTheOrderMoves) {
  // ½ (0.5 + 0 + 0.5) of 5 %.
  EXPECT_THAT(orderText(budgetOf("close", "all")), HasSubstr("0.50 % of the samples, 10 % of the"));
  BudgetRecord none = budgetOf("close", "all");
  none.total = {};
  EXPECT_EQ(orderText(none), "No error to attribute.");
}

TEST(BudgetFiles, HoldEveryFigure) {
  const nlohmann::json summary = nlohmann::json::parse(summaryJson(recordWithBudgets()));
  ASSERT_EQ(summary.at("budget").size(), 6U);
  const nlohmann::json& json = summary.at("budget").at(0);
  EXPECT_EQ(json.at("method"), "close");
  EXPECT_EQ(json.at("light"), "all");
  EXPECT_EQ(json.at("blocks"), 64);
  EXPECT_DOUBLE_EQ(json.at("order_dependence"), 0.005);
  EXPECT_DOUBLE_EQ(json.at("total").at("share"), 0.05);
  double sum =
      json.at("distant").at("share").get<double>() + json.at("other").at("share").get<double>();
  for (const nlohmann::json& cause : json.at("causes")) {
    sum += cause.at("forward").at("share").get<double>();
  }
  EXPECT_NEAR(sum, 0.05, 1e-15);
  const nlohmann::json& cause = json.at("causes").at(2);
  EXPECT_EQ(cause.at("cause"), "formula");
  EXPECT_DOUBLE_EQ(cause.at("backward").at("share"), 0.01);
  EXPECT_DOUBLE_EQ(cause.at("backward").at("low"), 0.009);
  EXPECT_DOUBLE_EQ(cause.at("backward").at("high"), 0.012);
  EXPECT_EQ(cause.at("forward").at("distinguishable"), false);
  EXPECT_DOUBLE_EQ(json.at("backward_states").at(2).at("false_shadow"), 0.04);
  EXPECT_TRUE(nlohmann::json::parse(summaryJson(test::sampleRecord())).at("budget").empty());
}

TEST(BudgetFiles, CsvHasARowAPart) {
  const std::string csv = budgetCsv(recordWithBudgets());
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 6 * 6);
  EXPECT_THAT(csv, HasSubstr("\nclose,atlas,all,total,0.05,0.049,0.052000000000000005,1,0.05,"));
  EXPECT_THAT(csv, HasSubstr("\n\"rough, \"\"old\"\"\",atlas,low,formula,0.005,"));
  EXPECT_THAT(csv, HasSubstr(",0,0.01,0.009000000000000001,0.012,1,0.0004\n"));
}

struct Rectangle {
  double left, width;
};

std::vector<Rectangle> rectangles(const std::string& svg) {
  static const std::regex pattern("<rect x=\"([0-9.]+)\" y=\"[0-9.]+\" width=\"([0-9.]+)\"");
  std::vector<Rectangle> found;
  for (std::sregex_iterator at(svg.begin(), svg.end(), pattern), end; at != end; ++at) {
    found.push_back({std::stod((*at)[1]), std::stod((*at)[2])});
  }
  return found;
}

/// Shares in one scale: what is above 0 stands to the right of the zero line without a gap, what is
/// below it to its left.
TEST(BudgetBars, DrawEveryShareWhereItBelongs) {
  const std::vector<BudgetRecord> budgets = {budgetOf("close", "all")};
  const std::vector<BudgetPart> parts = budgetParts(budgets);
  ASSERT_EQ(parts.size(), 5U);
  const std::vector<Rectangle> bars = rectangles(budgetBars(budgets, parts));
  ASSERT_EQ(bars.size(), 10U);
  const double zero = bars[0].left;
  const double scale = bars[0].width / 0.03;
  EXPECT_NEAR(bars[1].left, zero - 0.01 * scale, 0.05);
  EXPECT_NEAR(bars[1].width, 0.01 * scale, 0.05);
  EXPECT_NEAR(bars[2].left, zero + 0.03 * scale, 0.05);
  EXPECT_NEAR(bars[3].left, zero + 0.035 * scale, 0.05);
  EXPECT_NEAR(bars[4].left + bars[4].width, zero + 0.06 * scale, 0.05);
  EXPECT_NEAR(bars[5].width, 0.025 * scale, 0.05);
  EXPECT_NEAR(bars[9].left + bars[9].width, zero + 0.06 * scale, 0.05);
}

TEST(BudgetBars, KeyNamesEveryPartOnceWithAColourOfItsOwn) {
  const StudyRecord made = recordWithBudgets();
  const std::vector<BudgetPart> parts = budgetParts(made.budgets);
  ASSERT_EQ(parts.size(), 5U);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(parts[i].colour, parts[j].colour);
  }
  EXPECT_THAT(budgetKey(parts),
              AllOf(HasSubstr("1 map &lt;interpolation&gt;"), HasSubstr("5 left: other")));
}

TEST(BudgetBars, DrawAMethodWithoutErrors) {
  BudgetRecord none;
  none.method = "perfect";
  const std::vector<BudgetRecord> budgets = {none};
  EXPECT_THAT(budgetBars(budgets, budgetParts(budgets)),
              AllOf(HasSubstr("perfect"), Not(HasSubstr("nan"))));
}

TEST(BudgetHtml, IsASectionOfTheReport) {
  const std::string html = reportHtml(recordWithBudgets(), ".");
  EXPECT_THAT(html,
              AllOf(HasSubstr("<section id=\"budget\">"), HasSubstr("Where the error comes from"),
                    HasSubstr("map &lt;interpolation&gt;"), HasSubstr("float &amp; all"),
                    HasSubstr("+0.50 ≈"), HasSubstr("<b>−1.00</b>"),
                    HasSubstr("<details><summary>low</summary>")));
  EXPECT_THAT(html, Not(HasSubstr("map <interpolation>")));
  EXPECT_THAT(reportHtml(test::sampleRecord(), "."), Not(HasSubstr("id=\"budget\"")));
  // One light only: no second set of bars.
  StudyRecord single = test::sampleRecord();
  single.budgets = {budgetOf("close", "noon")};
  EXPECT_THAT(budgetSection(single),
              AllOf(HasSubstr("view atlas, noon"), Not(HasSubstr("<details>"))));
}

TEST(BudgetTerminal, FitsTheTerminal) {
  StudyRecord made = recordWithBudgets();
  made.budgets[0].causes[0].name = std::string(80, 'x');
  made.budgets[0].causes[0].forward.interval = {-0.123, -0.111};
  const std::string table = resultTable(made, false);
  EXPECT_THAT(table, AllOf(HasSubstr("Where the error comes from"), HasSubstr("+0.50 ≈"),
                           HasSubstr("left: distant occluders")));
  EXPECT_THAT(table, Not(HasSubstr("low, ")));
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(displayWidth(line), 100U) << line;
  EXPECT_THAT(resultTable(test::sampleRecord(), false), Not(HasSubstr("Where the error")));
}

}  // namespace
}  // namespace gnomon
