#include "report/tables/sweep_tables.h"

#include <fmt/core.h>

#include <algorithm>

#include "report/tables/means_table.h"
#include "report/text/number_text.h"
#include "study/judge/study_ranking.h"

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

}  // namespace gnomon::report
