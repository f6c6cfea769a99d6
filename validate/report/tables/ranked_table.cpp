#include "report/tables/ranked_table.h"

#include <fmt/core.h>

#include <algorithm>

#include "report/tables/cost_table.h"
#include "report/text/number_text.h"
#include "report/text/verdict_text.h"
#include "study/judge/ranking.h"

namespace gnomon::report {

namespace {

/// The sign behind a method; none for rank 1 itself, and for one that could not be compared.
std::string signOf(const study::RankedOverStudies& method) {
  return std::string(method.toBest ? differenceSign(method.toBest->verdict) : "");
}

/// "worse", "equal", …: empty for rank 1 itself, and for a method that could not be compared.
Cell toBestCell(const study::RankedOverStudies& method) {
  return textCell(std::string(method.toBest ? differenceVerdictName(method.toBest->verdict) : ""));
}

template <typename Methods>
std::vector<std::string> notesOf(const Methods& ranked) {
  std::vector<study::DifferenceRecord> toBest;
  for (const study::RankedOverStudies& method : ranked) {
    if (method.toBest) toBest.push_back(*method.toBest);
  }
  return noIntervalNotes(toBest);
}

/// The error at the right end of the bars: the largest of the errors, ends of intervals and ends of
/// the truth's uncertainty.
double barScale(const std::vector<study::RankedMethod>& ranked) {
  double scale = 0;
  for (const study::RankedMethod& method : ranked) {
    const double error = method.means.errorRate.value_or(0);
    scale = std::max({scale, error + method.uncertainty.value_or(0),
                      method.means.interval ? method.means.interval->high : 0});
  }
  return scale;
}

std::optional<ErrorBar> barOf(const study::RankedMethod& method, double scale) {
  if (!method.means.errorRate) return std::nullopt;
  return ErrorBar{*method.means.errorRate,
                  method.means.falseShadow.value_or(0),
                  method.means.falseLight.value_or(0),
                  method.uncertainty,
                  method.means.interval,
                  scale};
}

/// How many cases a mean leaves out, where it does.
Cell meanCell(const study::Mean& mean, std::size_t cases) {
  return valueCell(mean.value, mean.cases == cases
                                   ? ""
                                   : fmt::format("defined in {} of {} cases", mean.cases, cases));
}

Cell rankCell(std::optional<std::size_t> rank) {
  return valueCell(rank ? std::optional(static_cast<double>(*rank)) : std::nullopt);
}

Row rankedRow(const study::StudyRecord& record, const study::RankedMethod& method,
              const study::RankedMethod& best, double scale) {
  const study::CostRecord* cost = costOf(record, method.label);
  Cell name = textCell(method.label);
  name.bar = barOf(method, scale);
  name.about = likeText(method.like);
  Cell error = valueCell(method.means.errorRate);
  error.uncertainty = method.uncertainty;
  const auto mean = [&](const study::Mean& of) { return meanCell(of, method.cases); };
  return {
      {rankCell(method.rank), name, error,
       intervalCell(method.means.interval, method.means.interval ? "" : "no interval was measured"),
       method.toBest ? valueCell(method.toBest->difference) : textCell(""),
       method.toBest ? intervalCell(method.toBest->interval, method.toBest->reason) : textCell(""),
       valueCell(method.uncertainty), toBestCell(method), mean(method.testError),
       valueCell(method.means.falseShadow), valueCell(method.means.falseLight), mean(method.iou),
       mean(method.ber), countCell(method.cases), countCell(method.allCases),
       valueCell(method.leaderError),
       valueCell(cost ? std::optional(static_cast<double>(memoryBytes(*cost))) : std::nullopt),
       valueCell(cost ? cost->frameMs : std::nullopt)},
      signOf(method),
      method.rank ? ""
                  : fewerCasesText(method.cases, method.allCases, best.label, method.leaderError),
      !method.rank};
}

bool isTimed(const study::StudyRecord& record) {
  return std::any_of(record.cost.begin(), record.cost.end(),
                     [](const study::CostRecord& cost) { return cost.frameMs.has_value(); });
}

std::string rankedCaption(const study::StudyRecord& record,
                          const std::vector<study::RankedMethod>& ranked) {
  std::string text = fmt::format(
      "Means over all lights and views, in percent of {}, with 95\u202f% intervals of the error. "
      "Test: the error of the shadow test without the shading.",
      errorWhole(study::isSoft(record)));
  if (!ranked.empty() && ranked.front().uncertainty) {
    text += fmt::format(" The truth itself is uncertain by {}\u202f%.",
                        percentText(ranked.front().uncertainty));
  }
  text += fmt::format(" Compared with the best: {}.", signMeaning);
  if (!record.cost.empty() && !isTimed(record)) text += " No frame was timed.";
  return text;
}

Row overStudiesRow(const study::RankedOverStudies& method, const study::RankedOverStudies& best) {
  return {{rankCell(method.rank), textCell(study::labelWithName(method.label, method.names)),
           valueCell(method.meanError), valueCell(method.worstError), textCell(method.worstStudy),
           textCell(fmt::format("{} of {}", method.cases, method.allCases)),
           valueCell(method.uncertainty)},
          signOf(method),
          method.rank
              ? ""
              : fewerCasesText(method.cases, method.allCases, best.label, method.leaderError),
          !method.rank};
}

}  // namespace

Table rankedTable(const study::StudyRecord& record,
                  const std::vector<study::RankedMethod>& ranked) {
  using Q = Quantity;
  Table table{.kind = "ranking",
              .label = record.name,
              .title = record.heading(),
              .caption = rankedCaption(record, ranked),
              .columns = {{"", "rank", Q::rank, onPage | asData},
                          {"Method", "method", Q::name},
                          {"Error", "error_rate", Q::percent},
                          {"95 %", "", Q::interval},
                          {"To best", "", Q::signedPercent, onPage},
                          {"95 %", "", Q::interval, onPage},
                          {"", "uncertainty", Q::exact, asData},
                          {"", "to_best", Q::exact, asData},
                          {"Test", "test_error_rate", Q::percent, byAll & ~inColumn & ~onPage},
                          {"False shadow", "false_shadow", Q::percent},
                          {"False light", "false_light", Q::percent},
                          {"IoU", "iou", Q::percent, byAll & ~inColumn & ~onPage},
                          {"BER", "", Q::percent, 0U},
                          {"", "cases", Q::exact, asData},
                          {"", "all_cases", Q::exact, asData},
                          {"", "leader_error_rate", Q::exact, asData},
                          {"Memory", "bytes", Q::megabytes, byAll & ~onTerminal, "MB"},
                          {"Frame", "frame_ms", Q::decimals, onPage | onPaper | asData, "ms"}}};
  table.columns[2].isMain = true;
  table.columns[16].shortName = "MB";
  if (record.cost.empty()) table.columns[16].readers &= ~onPage;
  if (!isTimed(record)) table.columns[17].readers &= ~onPage;
  const double scale = barScale(ranked);
  for (const study::RankedMethod& method : ranked) {
    table.rows.push_back(rankedRow(record, method, ranked.front(), scale));
  }
  table.notes = notesOf(ranked);
  return table;
}

std::string errorWholeOver(std::span<const study::StudyMeans> studies) {
  const auto soft = std::count_if(studies.begin(), studies.end(),
                                  [](const study::StudyMeans& study) { return study.isSoft; });
  if (soft == 0 || soft == std::ssize(studies)) return errorWhole(soft > 0);
  return fmt::format("{} ({} where a light has a disc)", errorWhole(false), errorWhole(true));
}

Table rankedOverStudiesTable(std::span<const study::StudyMeans> studies,
                             const std::vector<study::RankedOverStudies>& ranked) {
  using Q = Quantity;
  Table table{.kind = "ranking",
              .label = "ranking",
              .title = fmt::format("Methods over {} studies", studies.size()),
              .caption = fmt::format(
                  "Error rate in percent of {}: in each study the mean over its lights and "
                  "views, then over the studies, each with the same weight. Compared with the "
                  "best: {}.",
                  errorWholeOver(studies), signMeaning),
              .columns = {{"", "rank", Q::rank},
                          {"Method", "method", Q::name},
                          {"Mean", "mean_error_rate", Q::percent},
                          {"Worst", "worst_error_rate", Q::percent},
                          {"Worst on", "worst_study", Q::text},
                          {"Cases", "cases", Q::exact},
                          {"Truth ±", "uncertainty", Q::percent}},
              .apart =
                  "Not in every case (a view under a light of a study): no rank, since means "
                  "over different cases cannot be compared."};
  table.columns[0].width = 2;
  table.columns[2].isMain = true;
  for (const std::size_t i : {2U, 3U}) table.columns[i].width = 8;
  for (const std::size_t i : {5U, 6U}) table.columns[i].width = 10;
  for (const study::RankedOverStudies& method : ranked) {
    table.rows.push_back(overStudiesRow(method, ranked.front()));
  }
  table.notes = notesOf(ranked);
  return table;
}

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
