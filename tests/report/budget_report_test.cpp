// An error budget in every kind of report.

#include <gmock/gmock.h>

#include <array>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "report/json/summary_json.h"
#include "report/page/report_html.h"
#include "report/page/terminal_report.h"
#include "report/plots/budget_plot.h"
#include "report/plots/study_plots.h"
#include "report/sample_record.h"
#include "report/tables/budget_table.h"
#include "report/tables/formats/csv_format.h"
#include "report/text/budget_text.h"
#include "report/text/text_width.h"

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
  const std::string csv = csvTable(budgetPartsTable(recordWithBudgets()));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 6 * 8);
  EXPECT_THAT(csv, HasSubstr("\nclose,atlas,all,total,0.05,0.049,0.052000000000000005,1,0.05,"));
  EXPECT_THAT(csv, HasSubstr("\n\"rough, \"\"old\"\"\",atlas,low,formula,0.005,"));
  EXPECT_THAT(csv, HasSubstr(",0,0.01,0.009000000000000001,0.012,1,0.0004\n"));
}

/// What one part's rectangles span in the plot's data, a bar each: left and right, percent.
std::vector<std::pair<double, double>> spans(const std::string& script, const std::string& part) {
  const std::size_t begin = script.find('\n', script.find("$" + part + " << EOD")) + 1;
  std::istringstream rows(script.substr(begin, script.find("EOD", begin) - begin));
  std::vector<std::pair<double, double>> found;
  double middle{};
  double y{};
  double left{};
  double right{};
  double bottom{};
  double top{};
  while (rows >> middle >> y >> left >> right >> bottom >> top) {
    EXPECT_NEAR(middle, (left + right) / 2, 1e-9);
    found.emplace_back(left, right);
  }
  return found;
}

/// What is above 0 stands to the right of the zero line without a gap, what is below it to its
/// left.
TEST(BudgetPlot, DrawsEveryShareWhereItBelongs) {
  const std::vector<study::BudgetRecord> budgets = {budgetOf("close", "all")};
  const std::string script = budgetPlot(budgets).commands;
  const auto near = [](double left, double right) {
    return ::testing::Pair(::testing::DoubleNear(left, 1e-9), ::testing::DoubleNear(right, 1e-9));
  };
  // Forward 3, -1, 0.5, then 0.5 and 2 that are left; backward 2.5, -1 and 1.
  EXPECT_THAT(spans(script, "p0"), ElementsAre(near(0, 3), near(0, 2.5)));
  EXPECT_THAT(spans(script, "p1"), ElementsAre(near(-1, 0), near(-1, 0)));
  EXPECT_THAT(spans(script, "p2"), ElementsAre(near(3, 3.5), near(2.5, 3.5)));
  EXPECT_THAT(spans(script, "p4"), ElementsAre(near(3.5, 4), near(3.5, 4)));
  EXPECT_THAT(spans(script, "p6"), ElementsAre(near(4, 6), near(4, 6)));
  EXPECT_THAT(script, HasSubstr("set arrow from 5,-0.48 to 5,1.48"));
}

TEST(BudgetPlot, NamesEveryPartOnceWithAColourOfItsOwn) {
  const std::string script = budgetPlot(budgetsOf(recordWithBudgets(), "all")).commands;
  static const std::regex legend("rgb '(#[0-9a-f]{6})' title '([^']*)'");
  std::set<std::string> colours;
  std::vector<std::string> names;
  for (std::sregex_iterator at(script.begin(), script.end(), legend), end; at != end; ++at) {
    colours.insert((*at)[1]);
    names.push_back((*at)[2]);
  }
  EXPECT_THAT(names, ElementsAre("map <interpolation>", "bits", "formula", "left: global",
                                 "left: distant", "left: seam", "left: other"));
  EXPECT_EQ(colours.size(), names.size());
}

TEST(BudgetPlot, DrawsAMethodWithoutErrors) {
  study::BudgetRecord none;
  none.method = "perfect";
  EXPECT_THAT(svgOf(budgetPlot(std::array{none})),
              AllOf(HasSubstr("perfect"), HasSubstr("</svg>")));
}

TEST(BudgetPlot, IsOneForAllLightsTogetherAndOneForEach) {
  std::vector<std::string> names;
  for (const PlotSheet& sheet : studyPlots(recordWithBudgets())) {
    if (sheet.section == "budget") names.push_back(sheet.name);
  }
  EXPECT_THAT(names, ElementsAre("budget", "budget_low", "budget_high"));
}

}  // namespace
}  // namespace gnomon::report
