#include "report/tables/long_table.h"

#include <algorithm>
#include <cmath>

#include "common/lists.h"
#include "report/tables/formats/csv_format.h"
#include "study/judge/baseline.h"
#include "study/judge/claim_cases.h"
#include "study/judge/distinguish.h"
#include "study/record/cases.h"
#include "study/record/result_metrics.h"

namespace gnomon::report {
namespace {

std::string unitOf(const study::StudyRecord& record, const study::ResultRecord& result,
                   compare::MetricId metric) {
  switch (metric.unit()) {
    case compare::MetricUnit::share:
      return "share";
    case compare::MetricUnit::correlation:
      return "correlation";
    case compare::MetricUnit::ratio:
      return "ratio";
    case compare::MetricUnit::count:
      return "count";
    case compare::MetricUnit::distance:
      break;
  }
  return contains(record.atlasViews, result.view) ? "texels" : "pixels";
}

/// Whether the table has a metric of a row: of the test alone only what ranks it.
bool isTold(const study::ResultRecord& result, compare::MetricId metric) {
  if (result.answer == study::Answer::drawn) return true;
  return result.region == study::wholeRegion &&
         contains(study::baselineMetrics(study::Answer::test), metric);
}

std::optional<compare::Interval> intervalOf(const study::StudyRecord& record,
                                            const study::ResultRecord& result,
                                            compare::MetricId metric) {
  const bool isScore = metric == compare::metrics::errorRate &&
                       result.region == study::wholeRegion && result.answer == study::Answer::drawn;
  if (!isScore) return std::nullopt;
  const auto confidence = study::findConfidence(record, result.view, result.light, result.method);
  return confidence ? confidence->interval : std::nullopt;
}

std::optional<double> uncertaintyOf(const study::StudyRecord& record,
                                    const study::ResultRecord& result, compare::MetricId metric) {
  // A length whose error was not measured would read as exact.
  if (metric.kind() != compare::MetricKind::rate &&
      !study::spreadOf(record, {result.view, result.light}, metric)) {
    return std::nullopt;
  }
  const double uncertainty = study::uncertaintyIn(record, result, metric);
  return std::isfinite(uncertainty) ? std::optional(uncertainty) : std::nullopt;
}

Cell sweptCell(const study::SweptValue& value) {
  return value.number ? valueCell(*value.number) : textCell(value.text);
}

Table emptyTable(const std::vector<study::SweptKey>& keys) {
  Table table{.kind = "long", .columns = {{"case", "", Quantity::exact}}};
  for (const study::SweptKey& key : keys) table.columns.push_back({key.key});
  for (const char* name : {"method", "view", "light", "answer", "region", "metric"}) {
    table.columns.push_back({name});
  }
  table.columns.push_back({"value", "", Quantity::exact});
  table.columns.push_back({"interval", "", Quantity::interval});
  table.columns.push_back({"uncertainty", "", Quantity::exact});
  table.columns.push_back({"unit"});
  return table;
}

/// The rows without the line of headings.
std::string csvRows(const Table& table) {
  const std::string csv = csvTable(table);
  return csv.substr(csv.find('\n') + 1);
}

}  // namespace

Table longTable(const std::vector<study::SweptKey>& keys, const study::SweepCase& which,
                std::size_t number, const study::StudyRecord& record) {
  Table table = emptyTable(keys);
  for (const study::ResultRecord& result : record.results) {
    for (const compare::Metric& metric : study::metricsOf(result)) {
      if (!metric.value || !isTold(result, metric.id)) continue;
      Row row{{countCell(number)}};
      for (const study::SweptValue& value : which.values) row.cells.push_back(sweptCell(value));
      for (const std::string& text :
           {result.method, result.view, result.light, std::string(study::answerName(result.answer)),
            result.region, std::string(metric.name())}) {
        row.cells.push_back(textCell(text));
      }
      row.cells.push_back(valueCell(metric.value));
      row.cells.push_back(intervalCell(intervalOf(record, result, metric.id)));
      row.cells.push_back(valueCell(uncertaintyOf(record, result, metric.id)));
      row.cells.push_back(textCell(unitOf(record, result, metric.id)));
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

std::string longCsv(const study::SweepRecord& sweep) {
  std::string csv = csvTable(emptyTable(sweep.keys));
  // Case by case: the cells of all would take many times the room of their text.
  for (std::size_t i = 0; i < sweep.steps.size(); ++i) {
    csv += csvRows(longTable(sweep.keys, sweep.cases.at(i), i + 1, sweep.steps[i]));
  }
  return csv;
}

std::string longCsv(const study::StudyRecord& record) {
  return csvTable(longTable({}, {record.name, {}}, 1, record));
}

}  // namespace gnomon::report
