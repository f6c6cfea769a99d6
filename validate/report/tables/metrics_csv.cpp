#include "report/tables/metrics_csv.h"

#include <string_view>
#include <vector>

#include "report/tables/csv_text.h"
#include "report/text/number_text.h"
#include "study/record/result_metrics.h"

namespace gnomon {
namespace {

std::vector<std::string> header() {
  std::vector<std::string> cells = {"study",   "method", "light", "view", "answer", "region",
                                    "samples", "tp",     "fp",    "fn",   "tn"};
  for (const std::string_view name : metricNames()) cells.emplace_back(name);
  return cells;
}

std::vector<std::string> row(const std::string& study, const ResultRecord& result) {
  const Counts& counts = result.counts;
  std::vector<std::string> cells = {study,
                                    result.method,
                                    result.light,
                                    result.view,
                                    std::string(answerName(result.answer)),
                                    result.region,
                                    std::to_string(counts.samples),
                                    exactText(counts.truePositive),
                                    exactText(counts.falsePositive),
                                    exactText(counts.falseNegative),
                                    exactText(counts.trueNegative)};
  for (const Metric& metric : metricsOf(result)) {
    cells.push_back(exactText(metric.value));
  }
  return cells;
}

}  // namespace

std::string metricsCsv(const StudyRecord& record) {
  std::string csv = csvLine(header());
  for (const ResultRecord& result : record.results) csv += csvLine(row(record.name, result));
  return csv;
}

}  // namespace gnomon
