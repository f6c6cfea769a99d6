#include "report/tables/ranked_table.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <limits>
#include <sstream>

#include "common/error.h"
#include "report/sample_record.h"
#include "report/tables/formats/csv_format.h"
#include "report/tables/formats/html_format.h"
#include "report/tables/formats/latex_format.h"
#include "report/tables/formats/markdown_format.h"
#include "support/lines.h"

namespace gnomon::report {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

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
  EXPECT_FALSE(study::rankMethods(record).front().interval) << "the atlas has none";
  record.confidence.push_back(row("atlas", "all", {0.02, 0.09}));
  const auto method = study::rankMethods(record).front();
  ASSERT_TRUE(method.interval);
  EXPECT_EQ(method.label, "best");
  EXPECT_DOUBLE_EQ(method.interval->low, 0.015);
  EXPECT_DOUBLE_EQ(method.interval->high, 0.06);
  record.confidence.back().interval.reset();
  EXPECT_FALSE(study::rankMethods(record).front().interval);
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
