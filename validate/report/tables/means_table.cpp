#include "report/tables/means_table.h"

#include <fmt/core.h>

#include <algorithm>

#include "report/tables/cost_table.h"
#include "report/text/number_text.h"

namespace gnomon::report {
double worstErrorOf(std::span<const study::StudyMeans> studies) {
  double worst = 0;
  for (const study::StudyMeans& study : studies) {
    for (const study::MethodMeans& method : study.methods) {
      worst = std::max(worst, method.errorRate.value_or(0));
    }
  }
  return worst;
}

Cell meanErrorCell(const study::MethodMeans* means, double worst) {
  if (means == nullptr) return valueCell({}, "not evaluated");
  if (!means->errorRate) return valueCell({}, "not defined");
  std::string about = fmt::format("false shadow {} %, false light {} %",
                                  percentText(means->falseShadow), percentText(means->falseLight));
  if (!means->isInEveryCase()) {
    about += fmt::format(", {} of {} cases", means->cases(), means->caseErrors.size());
  }
  Cell cell = heatCell(*means->errorRate, worst, std::move(about));
  if (!means->isInEveryCase()) cell.mark = study::fewerCasesMark;
  return cell;
}

namespace {

/// @param heads  a column a study
Table errorsTable(const std::vector<std::string>& labels,
                  std::span<const study::StudyMeans> studies, std::vector<Column> heads) {
  Table table{.kind = "regions", .columns = std::move(heads)};
  table.columns.insert(table.columns.begin(), Column{"Method", "method", Quantity::name});
  const double worst = worstErrorOf(studies);
  for (const std::string& label : labels) {
    Row row{{textCell(label)}};
    for (const study::StudyMeans& study : studies) {
      row.cells.push_back(meanErrorCell(study::findMeans(study, label), worst));
    }
    table.rows.push_back(std::move(row));
  }
  Row truth{{textCell("truth ±", "the truth’s uncertainty")}};
  for (const study::StudyMeans& study : studies)
    truth.cells.push_back(valueCell(study::largestUncertainty(study)));
  table.rows.push_back(std::move(truth));
  return table;
}

Column linkedColumn(const std::string& folder, const std::string& about = "") {
  Column column{folder, folder, Quantity::percent};
  column.about = about;
  column.link = folder + "/report.html";
  column.width = 9;
  return column;
}

/// error_rate, false_shadow, false_light, uncertainty.
void appendMeans(Row& row, const study::MethodMeans& method) {
  for (const auto& value :
       {method.errorRate, method.falseShadow, method.falseLight, method.uncertainty}) {
    row.cells.push_back(valueCell(value));
  }
}

void appendCases(Row& row, const study::MethodMeans& method) {
  row.cells.push_back(countCell(method.cases()));
  row.cells.push_back(countCell(method.caseErrors.size()));
}

std::vector<Column> dataColumns(std::initializer_list<const char*> texts,
                                std::initializer_list<const char*> values) {
  std::vector<Column> columns;
  for (const char* name : texts) columns.push_back({name});
  for (const char* name : values) columns.push_back({name, "", Quantity::exact});
  return columns;
}

}  // namespace

Table studyErrorsTable(const std::vector<std::string>& labels,
                       std::span<const study::StudyMeans> studies) {
  std::vector<Column> heads;
  for (const study::StudyMeans& study : studies)
    heads.push_back(linkedColumn(study.name, study.title));
  return errorsTable(labels, studies, std::move(heads));
}

Table sweepErrorsTable(const study::SweepRecord& sweep) {
  std::vector<study::StudyMeans> steps;
  std::vector<std::string> labels;
  std::vector<Column> heads;
  for (std::size_t i = 0; i < sweep.steps.size(); ++i) {
    steps.push_back(study::studyMeans(sweep.steps[i]));
    heads.push_back(linkedColumn(sweep.cases.at(i).name));
    if (!sweep.hasStepReports) heads.back().link.clear();
  }
  for (const study::MethodMeans& method : study::studyMeans(sweep).methods)
    labels.push_back(method.label);
  return errorsTable(labels, steps, std::move(heads));
}

std::string fewerCasesNote(std::span<const study::StudyMeans> studies) {
  for (const study::StudyMeans& study : studies) {
    for (const study::MethodMeans& method : study.methods) {
      if (!method.isInEveryCase()) return fmt::format(" {}", study::fewerCasesMeaning);
    }
  }
  return "";
}

Table studyMeansTable(std::span<const study::StudyMeans> studies) {
  Table table{
      .kind = "means",
      .columns = dataColumns({"study", "method"}, {"error_rate", "false_shadow", "false_light",
                                                   "uncertainty", "cases", "all_cases"})};
  for (const study::StudyMeans& study : studies) {
    for (const study::MethodMeans& method : study.methods) {
      Row row{{textCell(study.name), textCell(method.label)}};
      appendMeans(row, method);
      appendCases(row, method);
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

Table sweepMeansTable(const study::SweepRecord& sweep) {
  Table table{.kind = "means", .columns = {}};
  for (const study::SweptKey& key : sweep.keys) {
    table.columns.push_back({sweep.keys.size() == 1 ? "value" : key.key});
  }
  for (Column& column : dataColumns({"method"}, {"error_rate", "false_shadow", "false_light",
                                                 "uncertainty", "bytes", "cases", "all_cases"})) {
    table.columns.push_back(std::move(column));
  }
  for (std::size_t i = 0; i < sweep.steps.size(); ++i) {
    for (const study::MethodMeans& method : study::studyMeans(sweep.steps[i]).methods) {
      const study::CostRecord* cost = costOf(sweep.steps[i], method.label);
      Row row;
      for (const study::SweptValue& value : sweep.cases.at(i).values) {
        row.cells.push_back(value.number ? valueCell(*value.number) : textCell(value.text));
      }
      row.cells.push_back(textCell(method.label));
      appendMeans(row, method);
      row.cells.push_back(
          valueCell(cost ? std::optional(static_cast<double>(memoryBytes(*cost))) : std::nullopt));
      appendCases(row, method);
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

}  // namespace gnomon::report
