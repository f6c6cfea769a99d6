#include "report/tables/sweep_tables.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "common/lists.h"
#include "report/tables/ranked_table.h"
#include "report/tables/table.h"
#include "report/text/number_text.h"
#include "study/judge/claims.h"
#include "study/judge/distinguish.h"
#include "study/judge/gates.h"
#include "study/judge/ranking.h"
#include "study/record/cases.h"

namespace gnomon::report {

namespace {

std::vector<study::StudyMeans> stepMeans(const study::SweepRecord& sweep) {
  std::vector<study::StudyMeans> steps;
  for (const study::StudyRecord& step : sweep.steps) steps.push_back(study::studyMeans(step));
  return steps;
}

/// A method's error rate in each case.
std::vector<std::optional<double>> errorsOf(const std::vector<study::StudyMeans>& steps,
                                            const std::string& label) {
  std::vector<std::optional<double>> errors;
  for (const study::StudyMeans& step : steps) {
    const study::MethodMeans* means = study::findMeans(step, label);
    errors.push_back(means != nullptr ? means->errorRate : std::nullopt);
  }
  return errors;
}

std::string errorCaption(const study::SweepRecord& sweep) {
  return fmt::format("Error rate in percent of {}, mean over lights and views.",
                     errorWhole(study::isSoft(sweep)));
}

}  // namespace

Table sweepCasesTable(const study::SweepRecord& sweep) {
  Table table{.kind = "regions",
              .label = sweep.name,
              .title = sweep.title,
              .caption = errorCaption(sweep),
              .columns = {{"Case", "case", Quantity::name, onPage | asData}}};
  const std::vector<std::string> names = study::shortNames(sweep.keys);
  for (std::size_t k = 0; k < names.size(); ++k) {
    table.columns.push_back({names[k], sweep.keys[k].key});
  }
  const std::vector<study::StudyMeans> steps = stepMeans(sweep);
  const std::vector<std::string> labels = study::labelsOf(steps);
  for (const std::string& label : labels) {
    table.columns.push_back({label, label, Quantity::percent});
  }
  table.columns.push_back({"Truth ±", "uncertainty", Quantity::percent});
  const double worst = worstErrorOf(steps);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const study::SweepCase& which = sweep.cases.at(i);
    Row row{{textCell(which.name)}};
    if (sweep.hasStepReports) row.cells[0].link = which.name + "/report.html";
    for (const study::SweptValue& value : which.values) row.cells.push_back(textCell(value.text));
    for (const std::string& label : labels) {
      row.cells.push_back(meanErrorCell(study::findMeans(steps[i], label), worst));
    }
    row.cells.push_back(valueCell(study::largestUncertainty(steps[i])));
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::vector<ErrorSpread> errorSpreads(const study::SweepRecord& sweep) {
  std::vector<ErrorSpread> spreads;
  const std::vector<study::StudyMeans> steps = stepMeans(sweep);
  for (const std::string& label : study::labelsOf(steps)) {
    const std::vector<std::optional<double>> errors = errorsOf(steps, label);
    std::vector<std::optional<double>> defined;
    std::copy_if(errors.begin(), errors.end(), std::back_inserter(defined),
                 [](const auto& error) { return error.has_value(); });
    ErrorSpread spread;
    spread.method = label;
    spread.cases = defined.size();
    if (!defined.empty()) {
      // A case without a value is the least of all by std::optional's order.
      const auto largest = std::max_element(errors.begin(), errors.end());
      spread.mean = study::meanOf(defined);
      spread.least = *std::min_element(defined.begin(), defined.end());
      spread.largest = *largest;
      spread.largestAt = static_cast<std::size_t>(largest - errors.begin());
    }
    spreads.push_back(spread);
  }
  return spreads;
}

Table sweepSpreadTable(const study::SweepRecord& sweep) {
  Table table{.kind = "regions",
              .label = sweep.name,
              .title = sweep.title,
              .caption = fmt::format("{} Over {} cases.", errorCaption(sweep), sweep.cases.size()),
              .columns = {{"Method", "method", Quantity::name},
                          {"Mean", "mean", Quantity::percent},
                          {"Least", "least", Quantity::percent},
                          {"Largest", "largest", Quantity::percent},
                          {"Largest at", "largest_at", Quantity::text},
                          {"Cases", "cases", Quantity::count}}};
  for (const ErrorSpread& spread : errorSpreads(sweep)) {
    table.rows.push_back({{textCell(spread.method), valueCell(spread.mean), valueCell(spread.least),
                           valueCell(spread.largest),
                           textCell(spread.mean ? sweep.cases.at(spread.largestAt).name : "–"),
                           countCell(spread.cases)}});
  }
  return table;
}

namespace {

/// The methods × the values of the one key.
Table sweepValuesTable(const study::SweepRecord& sweep) {
  Table table = sweepErrorsTable(sweep);
  table.label = sweep.name;
  table.title = sweep.title;
  table.caption = fmt::format("{} By {}.", errorCaption(sweep), sweep.keys.front().axis);
  return table;
}

}  // namespace

Table readableSweepTable(const study::SweepRecord& sweep, std::size_t mostColumns,
                         std::size_t mostRows) {
  if (sweep.keys.size() == 1 && sweep.cases.size() <= mostColumns) return sweepValuesTable(sweep);
  return sweep.cases.size() <= mostRows ? sweepCasesTable(sweep) : sweepSpreadTable(sweep);
}

Table sweepPaperTable(const study::SweepRecord& sweep, const TabularRoom& room) {
  if (sweep.keys.size() == 1) {
    Table values = sweepValuesTable(sweep);
    if (fitsTabular(values, room)) return values;
  }
  constexpr std::size_t mostRows = 100;
  if (sweep.cases.size() <= mostRows) {
    Table cases = sweepCasesTable(sweep);
    if (fitsTabular(cases, room)) return cases;
  }
  return sweepSpreadTable(sweep);
}

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
