#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "common/error.h"
#include "compare/answer_metrics.h"
#include "report/json/summary_json.h"
#include "report/page/html_page.h"
#include "report/page/report_html.h"
#include "report/plots/study_plots.h"
#include "report/sample_record.h"
#include "report/tables/case_tables.h"
#include "report/tables/cost_table.h"
#include "report/tables/latex_table.h"
#include "report/tables/ranked_table.h"
#include "report/tables/table.h"
#include "report/terminal_page.h"
#include "report/terminal_report.h"
#include "study/record/record.h"
#include "support/lines.h"

namespace gnomon::report {
namespace {

using test::sampleRecord;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;

using CsvLines = std::vector<std::vector<std::string>>;

std::string metricsCsv(const study::StudyRecord& record) {
  return csvTable(metricsTable(record));
}

/// A reader of RFC 4180, written from the standard: quotes may hold commas, line breaks and doubled
/// quotes.
CsvLines parse(const std::string& csv) {
  CsvLines table;
  std::vector<std::string> row;
  std::string cell;
  bool inQuotes = false;
  for (std::size_t i = 0; i < csv.size(); ++i) {
    const char c = csv[i];
    if (inQuotes) {
      if (c != '"') {
        cell += c;
      } else if (i + 1 < csv.size() && csv[i + 1] == '"') {
        cell += csv[++i];
      } else {
        inQuotes = false;
      }
    } else if (c == '"') {
      EXPECT_TRUE(cell.empty()) << "a quote inside a bare cell";
      inQuotes = true;
    } else if (c == ',' || c == '\n') {
      row.push_back(std::exchange(cell, ""));
      if (c == '\n') table.push_back(std::exchange(row, {}));
    } else {
      cell += c;
    }
  }
  EXPECT_TRUE(row.empty() && cell.empty() && !inQuotes) << "the last line is not ended";
  return table;
}

std::size_t column(const CsvLines& table, const std::string& name) {
  for (std::size_t i = 0; i < table[0].size(); ++i) {
    if (table[0][i] == name) return i;
  }
  ADD_FAILURE() << "no column " << name;
  return 0;
}

TEST(MetricsCsv, OneRowAResultAndOneCellAColumn) {
  const study::StudyRecord record = sampleRecord();
  const CsvLines table = parse(metricsCsv(record));
  ASSERT_EQ(table.size(), 1 + 3 * 2 * 4U);
  for (const auto& row : table) EXPECT_EQ(row.size(), 11U + 22);
  EXPECT_EQ(metricsCsv(record).substr(0, 64),
            "study,method,light,view,answer,region,samples,tp,fp,fn,tn,error_");
}

TEST(MetricsCsv, ValuesReadBackExactly) {
  const study::StudyRecord record = sampleRecord();
  const CsvLines table = parse(metricsCsv(record));
  for (std::size_t i = 0; i < record.results.size(); ++i) {
    const study::ResultRecord& result = record.results[i];
    const auto& row = table[i + 1];
    EXPECT_EQ(row[0], record.name);
    EXPECT_EQ(row[1], result.method);
    EXPECT_EQ(row[2], result.light);
    EXPECT_EQ(row[3], result.view);
    EXPECT_EQ(row[4], study::answerName(result.answer));
    EXPECT_EQ(row[5], result.region);
    EXPECT_EQ(row[6], std::to_string(result.counts.samples));
    EXPECT_EQ(std::stod(row[column(table, "fp")]), result.counts.falsePositive);
    for (const compare::Metric& metric : study::metricsOf(result)) {
      const std::string& cell = row[column(table, std::string(metric.name()))];
      EXPECT_EQ(cell.empty(), !metric.value.has_value());
      if (metric.value) {
        EXPECT_EQ(std::stod(cell), *metric.value);
      }
    }
  }
}

TEST(MetricsCsv, NumbersAreTheShortestThatReadBack) {
  study::StudyRecord record = sampleRecord();
  record.results = {{"m", "l", "v", "all", compare::Counts{0.1, 1e-7, 0, 0.30000000000000004, 3}}};
  EXPECT_NE(metricsCsv(record).find("all,3,0.1,1e-07,0,0.30000000000000004,"), std::string::npos);
}

TEST(MetricsCsv, RefusesNumbersThatAreNotFinite) {
  study::StudyRecord record = sampleRecord();
  record.results[0].counts.trueNegative = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(metricsCsv(record), InternalError);
}

TEST(MetricsCsv, HasColumnsOfSharesOnlyUnderADisc) {
  study::StudyRecord record = sampleRecord();
  const std::size_t columns = metricsTable(record).columns.size();
  using enum compare::MetricKind;
  const auto ids = compare::metricsOfKinds({share, penumbra});
  for (const compare::MetricId id : ids) record.results.front().shares.push_back({id, 0.125, {}});
  const Table table = metricsTable(record);
  EXPECT_EQ(table.columns.size(), columns + ids.size());
  for (const Row& row : table.rows) EXPECT_EQ(row.cells.size(), table.columns.size());
}

/// The three of the paper's section 4: 4, 5 and 16 ms a frame.
study::StudyRecord threeMethods() {
  study::StudyRecord record;
  record.environment.glRenderer = "A <rasteriser>";
  record.methods = {{"flat", "max-forsyth", "", ""},
                    {"onoue-2004", "onoue-2004", "", ""},
                    {"shadow-volume", "shadow-volume", "", ""}};
  record.cost = {{"flat", 960, 524'288, 0, 4.0, 4.0},
                 {"onoue-2004", 960, 1'048'576, 16'384, 5.0, 5.0},
                 {"shadow-volume", 1'234'567, 0, 0, 16.0, 12.0, 24.5, 3}};
  return record;
}

TEST(Cost, IsSetAgainstTheMethodOfTheNameWhateverItsLabel) {
  study::StudyRecord record = threeMethods();
  EXPECT_EQ(frameRatio(record, record.cost[0]), 1.0);
  EXPECT_EQ(frameRatio(record, record.cost[1]), 1.25);
  EXPECT_EQ(frameRatio(record, record.cost[2]), 4.0);
  // One that bears the name as its label goes before.
  record.methods.push_back({"max-forsyth", "max-forsyth", "", ""});
  record.cost.push_back({"max-forsyth", 960, 0, 0, 2.0});
  EXPECT_EQ(frameRatio(record, record.cost[1]), 2.5);
}

TEST(Cost, HasNoRatioWhereEitherWasNotTimed) {
  study::StudyRecord record = threeMethods();
  record.cost[1].frameMs.reset();
  EXPECT_FALSE(frameRatio(record, record.cost[1]));
  record.cost[0].frameMs = 0;
  EXPECT_FALSE(frameRatio(record, record.cost[2]));
  record.cost[0].frameMs.reset();
  EXPECT_FALSE(frameRatio(record, record.cost[2]));
  record = threeMethods();
  record.methods[0].name = "another";
  EXPECT_FALSE(frameRatio(record, record.cost[2]));
}

TEST(Cost, RefusesATimeThatIsNotFinite) {
  study::StudyRecord record = threeMethods();
  record.cost[0].frameMs = std::numeric_limits<double>::infinity();
  EXPECT_THROW((void)frameRatio(record, record.cost[1]), InternalError);
}

TEST(Cost, SaysNothingOfThePaperUnlessAllThreeWereTimed) {
  for (std::size_t i = 0; i < 3; ++i) {
    study::StudyRecord record = threeMethods();
    record.cost[i].frameMs.reset();
    EXPECT_EQ(publishedRates(record), "");
    record = threeMethods();
    record.methods[i].name = "another";
    EXPECT_EQ(publishedRates(record), "");
  }
}

/// A study of one light and view: entries of a method, its memory and wrong samples of a thousand.
struct Entry {
  std::string label, name;
  std::uint64_t tables, heights;
  double wrong;
};

study::StudyRecord recordOf(const std::vector<Entry>& entries) {
  study::StudyRecord record;
  for (const Entry& entry : entries) {
    record.methods.push_back({entry.label, entry.name, "", ""});
    study::ResultRecord result{entry.label, "one light", "one view", "all", {}};
    result.counts.samples = 1000;
    result.counts.truePositive = 400;
    result.counts.trueNegative = 600 - entry.wrong;
    result.counts.falsePositive = entry.wrong;
    record.results.push_back(result);
    study::CostRecord cost;
    cost.method = entry.label;
    cost.tableBytes = entry.tables;
    cost.heightBytes = entry.heights;
    record.cost.push_back(cost);
  }
  return record;
}

std::vector<FrontierPoint> byMemory(const std::vector<Entry>& entries) {
  return frontier(recordOf(entries), Price::memory);
}

TEST(Frontier, KeepsWhatNoSmallerTableBeats) {
  const auto points = byMemory({{"a 8", "a", 800, 0, 50},
                                {"a 16", "a", 1600, 0, 20},
                                {"b", "b", 800, 100, 60},
                                {"c", "c", 1600, 400, 20},
                                {"d", "d", 0, 400, 70}});
  ASSERT_EQ(points.size(), 5U);
  std::vector<std::string> efficient;
  for (const FrontierPoint& point : points) {
    if (point.efficient) efficient.push_back(point.label);
  }
  EXPECT_EQ(efficient, (std::vector<std::string>{"d", "a 8", "a 16"}));
  EXPECT_TRUE(std::is_sorted(points.begin(), points.end(),
                             [](const auto& p, const auto& q) { return p.price < q.price; }));
  EXPECT_DOUBLE_EQ(points.back().price, 2000);
  EXPECT_DOUBLE_EQ(points.front().errorRate, 0.07);
}

TEST(Frontier, OfEqualMemoryTheBetterOneIsEfficient) {
  const auto points =
      byMemory({{"a", "a", 800, 0, 50}, {"b", "b", 800, 0, 30}, {"a2", "a", 900, 0, 40}});
  ASSERT_EQ(points.size(), 3U);
  EXPECT_EQ(points[0].label, "b");
  EXPECT_TRUE(points[0].efficient);
  EXPECT_FALSE(points[1].efficient);
  EXPECT_FALSE(points[2].efficient);
}

TEST(Frontier, IsEmptyWhereThereIsNothingToTrade) {
  EXPECT_TRUE(byMemory({{"a", "a", 800, 0, 50}, {"b", "b", 900, 0, 30}}).empty());
  EXPECT_TRUE(byMemory({}).empty());
  // Without tables there is no memory to draw.
  EXPECT_EQ(byMemory({{"n", "n", 0, 0, 9}, {"a", "a", 8, 0, 5}, {"a2", "a", 9, 0, 4}}).size(), 2U);
}

TEST(Frontier, LeavesOutWhatAnswersInFewerCases) {
  // "a 16" would win, but was asked only under one of two lights.
  study::StudyRecord record = recordOf({{"a 8", "a", 800, 0, 50}, {"a 16", "a", 1600, 0, 1}});
  record.methods.push_back({"a 32", "a", "", ""});
  record.cost.push_back({"a 32", 960, 3200, 0, std::nullopt});
  for (const char* light : {"one light", "other light"}) {
    record.results.push_back(record.results.front());
    record.results.back().method = "a 32";
    record.results.back().light = light;
  }
  record.results.push_back(record.results.front());
  record.results.back().light = "other light";
  const auto points = frontier(record, Price::memory);
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].label, "a 8");
  EXPECT_EQ(points[1].label, "a 32");
}

TEST(Frontier, MayBeAskedForTheTimeOfAFrame) {
  study::StudyRecord record =
      recordOf({{"a 8", "a", 800, 0, 50}, {"a 16", "a", 800, 0, 20}, {"b", "b", 0, 0, 10}});
  EXPECT_TRUE(frontier(record, Price::frameTime).empty()) << "nothing was timed";
  record.cost[0].frameMs = 4;
  record.cost[1].frameMs = 3;
  EXPECT_EQ(frontier(record, Price::frameTime).size(), 2U);
  record.cost[2].frameMs = 9;
  const auto points = frontier(record, Price::frameTime);
  ASSERT_EQ(points.size(), 3U);
  EXPECT_EQ(points[0].label, "a 16");
  EXPECT_EQ(points[0].price, 3);
  EXPECT_FALSE(points[1].efficient) << "slower and worse";
  EXPECT_TRUE(points[2].efficient) << "no table, and no memory";
  EXPECT_TRUE(frontier(record, Price::memory).empty()) << "of memory there is one choice";
  const std::vector<LinePlot> plots = studyPlots(record, {"a 8"});
  ASSERT_EQ(plots.size(), 1U);
  EXPECT_EQ(plots[0].name, "frontier_time");
  EXPECT_EQ(plots[0].section, "cost");
  // The frontier of all, and the entries of the method that is shown.
  ASSERT_EQ(plots[0].curves.size(), 2U);
  EXPECT_EQ(plots[0].curves[1].points.size(), 2U);
}

TEST(Frontier, RowsHoldEveryEntry) {
  const study::StudyRecord record =
      recordOf({{"a, 8", "a", 800, 0, 50}, {"a 16", "a", 1600, 0, 0}});
  const auto points = frontier(record, Price::memory);
  EXPECT_EQ(csvTable(frontierTable(points)),
            "method,shader,bytes,error_rate,efficient\n\"a, 8\",a,800,0.05,1\na 16,a,1600,0,1\n");
}

study::StudyRecord recordWithIntervals() {
  study::StudyRecord made = test::sampleRecord();
  test::addDifferences(made, 1e-6);
  made.confidence = {{"best", "camera", "all", 0.01, compare::Interval{0.0075, 0.0125}, "", 25, 40},
                     {"best", "camera", "elevation 15°", 0.01, compare::Interval{0, 1}, "", 25, 40},
                     {"close", "camera", "all", 0.012, std::nullopt, "too few blocks", 25, 40}};
  return made;
}

std::string tableCsv(const study::StudyRecord& record) {
  return csvTable(rankedTable(record, study::rankMethods(record)));
}

std::string tableTex(const study::StudyRecord& record) {
  return latexTabular(rankedTable(record, study::rankMethods(record)));
}

/// The cells of a row, split at ampersands that are not escaped.
std::vector<std::string> latexCells(const std::string& row) {
  std::vector<std::string> cells(1);
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (row[i] == '&' && (i == 0 || row[i - 1] != '\\')) {
      cells.emplace_back();
    } else {
      cells.back() += row[i];
    }
  }
  return cells;
}

TEST(TableTex, HoldsTheSameInPercent) {
  std::vector<std::vector<std::string>> rows;
  for (const std::string& line : test::linesOf(tableTex(recordWithIntervals()))) {
    if (line.ends_with("\\\\")) rows.push_back(latexCells(line.substr(0, line.size() - 3)));
  }
  ASSERT_THAT(rows, SizeIs(5)) << "two of headings";
  for (const auto& row : rows) EXPECT_THAT(row, SizeIs(6)) << "what a column has room for";
  EXPECT_THAT(rows[2],
              ElementsAre("  best ", " 1.00 ", " 0.75--1.25 ", " 0.50 ", " 0.50 ", " 0.54"));
  EXPECT_THAT(rows[3],
              ElementsAre("  $\\approx$~close ", " 1.20 ", " -- ", " 0.40 ", " 0.80 ", " 1.05"));
  EXPECT_EQ(rows[4][0], "  rough, \\char34{}old\\char34{} ");
}

/// "best" lacks the second light: "close" leads, and has 12 of 1000 wrong under the first.
TEST(TableFiles, KeepAMethodThatAnswersInFewerCasesApart) {
  study::StudyRecord record = recordWithIntervals();
  std::erase_if(record.results, [](const study::ResultRecord& row) {
    return row.method == "best" && row.light != "elevation 15°";
  });
  const std::vector<std::string> csv = test::linesOf(tableCsv(record));
  ASSERT_THAT(csv, SizeIs(4));
  EXPECT_TRUE(csv[1].starts_with("1,close,")) << csv[1];
  EXPECT_TRUE(csv[3].starts_with(",best,0.01,")) << csv[3];
  EXPECT_TRUE(csv[3].ends_with(",1,2,0.012,540672,1.25")) << csv[3];
  const std::string tex = tableTex(record);
  EXPECT_THAT(tex, HasSubstr("  \\midrule\n  best & 1.00"));
  EXPECT_THAT(tex, HasSubstr("% best: in 1 of 2 cases: no rank; close has 1.20 % on the same"));
}

/// Braces, environments and math are balanced, and nothing special stands alone.
TEST(TableTex, IsWellFormedWhateverTheText) {
  study::StudyRecord evil = recordWithIntervals();
  evil.title = "50 % of {it} & $x_1^2$ # ~ \\end{table} é κ ≈ \n";
  evil.name = "a/b_c%";
  for (study::ResultRecord& row : evil.results) row.method += "_&%#{";
  std::string tex;
  for (const std::string& line : test::linesOf(tableTex(evil))) {
    if (!line.starts_with("%")) tex += line + "\n";
  }
  int depth = 0;
  int dollars = 0;
  std::string begun;
  for (std::size_t i = 0; i < tex.size(); ++i) {
    if (tex[i] == '\\') {
      ++i;
      continue;
    }
    depth += tex[i] == '{' ? 1 : tex[i] == '}' ? -1 : 0;
    dollars += tex[i] == '$' ? 1 : 0;
    ASSERT_GE(depth, 0);
    EXPECT_TRUE(tex[i] != '#' && tex[i] != '^' && tex[i] != '_') << i;
    const bool endsLine = tex.compare(i, 2, "%\n") == 0;
    EXPECT_TRUE(tex[i] != '%' || endsLine) << "a comment would swallow the line";
  }
  EXPECT_EQ(depth, 0);
  EXPECT_EQ(dollars % 2, 0);
  for (const char* mark : {"\\begin{tabular}", "\\end{tabular}"}) {
    EXPECT_NE(tex.find(mark), std::string::npos);
    EXPECT_EQ(tex.find(mark), tex.rfind(mark)) << mark;
  }
  EXPECT_THAT(tex, HasSubstr("close\\_\\&\\%\\#\\{"));
  EXPECT_THAT(tableTex(evil), HasSubstr("uncertain by 0.30\u202f%"));
}

/// The mean over views, all lights together; none unless each view has one.
TEST(RankedTable, MeansTheIntervalsOfItsViews) {
  study::StudyRecord record = test::sampleRecord();
  const std::size_t rows = record.results.size();
  for (std::size_t i = 0; i < rows; ++i) {
    record.results.push_back(record.results[i]);
    record.results.back().view = "atlas";
  }
  const auto row = [](const std::string& view, const std::string& light,
                      compare::Interval interval) {
    return study::ConfidenceRecord{"best", view, light, 0.01, interval, "", 25, 40};
  };
  record.confidence = {row("camera", "all", {0.01, 0.03}),
                       row("camera", "elevation 15°", {0.5, 0.9})};
  EXPECT_FALSE(study::rankMethods(record).front().means.interval) << "the atlas has none";
  record.confidence.push_back(row("atlas", "all", {0.02, 0.09}));
  const auto method = study::rankMethods(record).front();
  ASSERT_TRUE(method.means.interval);
  EXPECT_EQ(method.label, "best");
  EXPECT_DOUBLE_EQ(method.means.interval->low, 0.015);
  EXPECT_DOUBLE_EQ(method.means.interval->high, 0.06);
  record.confidence.back().interval.reset();
  EXPECT_FALSE(study::rankMethods(record).front().means.interval);
}

TEST(RankedTable, DrawsItsBarsInOneScale) {
  study::StudyRecord record = recordWithIntervals();
  const Table table = rankedTable(record, study::rankMethods(record));
  ASSERT_THAT(table.rows, SizeIs(3));
  for (const Row& row : table.rows) {
    ASSERT_TRUE(row.cells[1].bar);
    // "rough" has 10 % wrong, uncertain by 0.3 %: the largest.
    EXPECT_DOUBLE_EQ(row.cells[1].bar->scale, 0.103);
  }
  EXPECT_EQ(table.rows[0].cells[1].bar->interval->high, 0.0125);
}

TEST(TableFiles, RefuseNumbersThatAreNone) {
  study::StudyRecord broken = recordWithIntervals();
  broken.confidence[0].interval->low = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)tableTex(broken), InternalError);
  EXPECT_THROW((void)tableCsv(broken), InternalError);
}

}  // namespace
}  // namespace gnomon::report
