#include "report/tables/case_tables.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "common/error.h"
#include "compare/share_metrics.h"
#include "report/sample_record.h"
#include "report/tables/formats/csv_format.h"
#include "study/record/result_metrics.h"

namespace gnomon::report {
namespace {

using test::sampleRecord;
using Lines = std::vector<std::vector<std::string>>;

std::string metricsCsv(const study::StudyRecord& record) {
  return csvTable(metricsTable(record));
}

/// A reader of RFC 4180, written from the standard: quotes may hold commas, line breaks and doubled
/// quotes.
Lines parse(const std::string& csv) {
  Lines table;
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

std::size_t column(const Lines& table, const std::string& name) {
  for (std::size_t i = 0; i < table[0].size(); ++i) {
    if (table[0][i] == name) return i;
  }
  ADD_FAILURE() << "no column " << name;
  return 0;
}

TEST(MetricsCsv, OneRowAResultAndOneCellAColumn) {
  const study::StudyRecord record = sampleRecord();
  const Lines table = parse(metricsCsv(record));
  ASSERT_EQ(table.size(), 1 + 3 * 2 * 4U);
  for (const auto& row : table) EXPECT_EQ(row.size(), 11 + study::pointLightMetricNames().size());
  EXPECT_EQ(metricsCsv(record).substr(0, 64),
            "study,method,light,view,answer,region,samples,tp,fp,fn,tn,error_");
}

TEST(MetricsCsv, ValuesReadBackExactly) {
  const study::StudyRecord record = sampleRecord();
  const Lines table = parse(metricsCsv(record));
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
      const std::string& cell = row[column(table, std::string(metric.name))];
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
  for (const std::string_view name : compare::shareMetricNames()) {
    record.results.front().shares.push_back({name, 0.125, {}});
  }
  const Table table = metricsTable(record);
  EXPECT_EQ(table.columns.size(), columns + compare::shareMetricNames().size());
  for (const Row& row : table.rows) EXPECT_EQ(row.cells.size(), table.columns.size());
}

}  // namespace
}  // namespace gnomon::report
