#include "report/tables/case_tables.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "common/lists.h"
#include "report/plots/line_plot.h"
#include "report/tables/confidence.h"
#include "report/text/number_text.h"
#include "report/text/verdict_text.h"
#include "study/judge/distinguish.h"
#include "study/record/cases.h"

namespace gnomon::report {

namespace {

struct CaseMetric {
  compare::MetricId metric;
  const char* name;
  Quantity quantity = Quantity::percent;
  unsigned readers = byAll;
  study::Answer answer = study::Answer::drawn;
};

constexpr std::array<CaseMetric, 9> caseMetrics = {
    {{"error_rate", "Error"},
     {"error_rate", "Test", Quantity::percent, byAll, study::Answer::test},
     {"false_shadow", "False shadow"},
     {"false_light", "False light"},
     {"iou", "IoU"},
     {"f1", "F1", Quantity::percent, byAll & ~onTerminal},
     {"ber", "BER"},
     {"mcc", "MCC", Quantity::correlation, byAll & ~onTerminal},
     {"shadow_length_ratio", "Length", Quantity::ratio}}};

/// The median, with the quartiles and the count for whoever points at it.
Cell lengthCell(const study::ResultRecord& row, const compare::Metric& ratio) {
  Cell cell = metricCell(ratio);
  if (!ratio.value) return cell;
  const auto text = [&](compare::MetricId id) { return ratioText(study::metricOf(row, id).value); };
  cell.about = fmt::format("quartiles {} and {} over {:.0f} runs", text("shadow_length_q1"),
                           text("shadow_length_q3"), row.lengths->runs);
  return cell;
}

Cell caseCell(const study::StudyRecord& record, const study::ResultRecord& drawn,
              const CaseMetric& column) {
  const study::ResultRecord* of = study::findResult(record, drawn.method, {drawn.view, drawn.light},
                                                    study::wholeRegion, column.answer);
  if (of == nullptr) return {};
  const compare::Metric metric = study::metricOf(*of, column.metric);
  return column.quantity == Quantity::ratio ? lengthCell(*of, metric) : metricCell(metric);
}

/// One case's results, and the one whose error is the smallest.
struct CaseResults {
  std::vector<const study::ResultRecord*> all;
  const study::ResultRecord* best = nullptr;
};

CaseResults resultsOf(const study::StudyRecord& record, const std::vector<std::string>& methods,
                      const study::Case& which) {
  const auto errorOf = [](const study::ResultRecord& result) {
    return study::metricOf(result, compare::metrics::errorRate).value;
  };
  CaseResults results;
  for (const std::string& method : methods) {
    const study::ResultRecord* row = study::findResult(record, method, which);
    if (row == nullptr) continue;
    results.all.push_back(row);
    const auto error = errorOf(*row);
    const auto least = results.best != nullptr ? errorOf(*results.best) : std::nullopt;
    if (results.best == nullptr || (error && (!least || *error < *least))) results.best = row;
  }
  return results;
}

/// Of each method of a case those that it is not known to differ from, in the record's order.
std::map<std::string, study::LikeMethods> likeMethods(const study::StudyRecord& record,
                                                      const study::Case& which) {
  std::map<std::string, study::LikeMethods> like;
  for (const study::DifferenceRecord& row : study::differencesIn(record, which.view, which.light)) {
    like[row.first].add(row.second, row.verdict);
    like[row.second].add(row.first, row.verdict);
  }
  return like;
}

Cell methodCell(const std::string& method, const study::LikeMethods& like) {
  Cell cell = textCell(method);
  cell.about = likeText(like);
  return cell;
}

Cell regionCell(const study::ResultRecord* row, double worst) {
  if (row == nullptr) return valueCell({}, "not evaluated");
  const compare::Metric error = compare::rate(row->counts, compare::metrics::errorRate);
  if (!error.value) return metricCell(error);
  return heatCell(
      *error.value, worst,
      fmt::format("{} samples, false shadow {} %, false light {} %",
                  groupedText(row->counts.samples),
                  percentText(compare::rate(row->counts, compare::metrics::falseShadow).value),
                  percentText(compare::rate(row->counts, compare::metrics::falseLight).value)));
}

/// The samples of a region, where all methods were asked at the same ones.
std::string regionSamples(const study::StudyRecord& record, const std::vector<std::string>& methods,
                          const study::Case& which, std::string_view region) {
  std::optional<std::size_t> samples;
  for (const std::string& method : methods) {
    const study::ResultRecord* row = study::findResult(record, method, which, region);
    if (row == nullptr) continue;
    if (samples && *samples != row->counts.samples) return "differing samples";
    samples = row->counts.samples;
  }
  return samples ? groupedText(*samples) + " samples" : "";
}

/// samples, tp, fp, fn, tn.
void appendCounts(Row& row, const compare::Counts& counts) {
  row.cells.push_back(countCell(counts.samples));
  for (const double value :
       {counts.truePositive, counts.falsePositive, counts.falseNegative, counts.trueNegative}) {
    row.cells.push_back(valueCell(value));
  }
}

void addTexts(Table& table, std::initializer_list<const char*> names) {
  for (const char* name : names) table.columns.push_back({name});
}

template <typename Names>
void addValues(Table& table, const Names& names) {
  for (const auto& name : names) {
    table.columns.push_back({std::string(name), "", Quantity::exact});
  }
}

constexpr std::array<const char*, 5> countNames = {"samples", "tp", "fp", "fn", "tn"};
constexpr std::array<compare::MetricId, 3> binRates = {"error_rate", "false_shadow", "false_light"};

}  // namespace

Table caseTable(const study::StudyRecord& record, std::span<const study::Case> cases) {
  Table table{.kind = "metrics", .columns = {{"Method", "method", Quantity::name}}};
  const bool namesLights = cases.size() > 1;
  if (namesLights) table.columns.insert(table.columns.begin(), Column{"Light", "light"});
  for (const CaseMetric& metric : caseMetrics) {
    table.columns.push_back(
        {metric.name, std::string(metric.metric.name()), metric.quantity, metric.readers});
    if (metric.quantity == Quantity::correlation) table.columns.back().note = "−1 to 1";
  }
  const std::vector<std::string> methods = study::methodsOf(record);
  std::vector<study::DifferenceRecord> toBest;
  for (const study::Case& which : cases) {
    const CaseResults results = resultsOf(record, methods, which);
    std::map<std::string, study::LikeMethods> like = likeMethods(record, which);
    for (const study::ResultRecord* result : results.all) {
      Row row;
      // A light's name stands once, in its first row.
      if (namesLights)
        row.cells.push_back(textCell(result == results.all.front() ? which.light : ""));
      row.cells.push_back(methodCell(result->method, like[result->method]));
      for (const CaseMetric& metric : caseMetrics) {
        row.cells.push_back(caseCell(record, *result, metric));
      }
      const auto behind = study::differenceOf(record, which.view, which.light, result->method,
                                              results.best->method);
      if (behind) {
        row.mark = differenceSign(behind->verdict);
        toBest.push_back(*behind);
      }
      table.rows.push_back(std::move(row));
    }
  }
  table.notes = noIntervalNotes(toBest);
  return table;
}

Table caseErrorsTable(const study::StudyRecord& record, const std::vector<std::string>& methods,
                      std::span<const study::Case> cases, std::span<const std::string> links) {
  Table table{.kind = "regions", .columns = {{"View and light", "case", Quantity::name}}};
  double worst = 0;
  for (const std::string& method : methods) {
    table.columns.push_back({method, method, Quantity::percent});
    for (const study::Case& which : cases) {
      worst = std::max(worst, study::rateOf(record, method, which, study::Answer::drawn,
                                            compare::metrics::errorRate)
                                  .value_or(0));
    }
  }
  for (std::size_t i = 0; i < cases.size(); ++i) {
    Row row{{textCell(cases[i].view + " · " + cases[i].light)}};
    row.cells.front().link = links[i];
    for (const std::string& method : methods) {
      row.cells.push_back(regionCell(study::findResult(record, method, cases[i]), worst));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table regionTable(const study::StudyRecord& record, const study::Case& which) {
  Table table{.kind = "regions", .columns = {{"Method", "method", Quantity::name}}};
  const std::vector<std::string> regions = study::regionsOf(record, which);
  if (regions.size() < 2) return table;
  const std::vector<std::string> methods = study::methodsOf(record);
  double worst = 0;
  for (const std::string& region : regions) {
    Column column{region, region, Quantity::percent};
    column.note = regionSamples(record, methods, which, region);
    table.columns.push_back(std::move(column));
    for (const std::string& method : methods) {
      const study::ResultRecord* row = study::findResult(record, method, which, region);
      if (row == nullptr) continue;
      worst = std::max(worst,
                       compare::rate(row->counts, compare::metrics::errorRate).value.value_or(0));
    }
  }
  for (const std::string& method : methods) {
    if (study::findResult(record, method, which) == nullptr) continue;
    Row row{{textCell(method)}};
    for (const std::string& region : regions) {
      row.cells.push_back(regionCell(study::findResult(record, method, which, region), worst));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table metricsTable(const study::StudyRecord& record) {
  Table table{.kind = "metrics", .columns = {}};
  addTexts(table, {"study", "method", "light", "view", "answer", "region"});
  addValues(table, countNames);
  // Columns of shares only where a light has a disc.
  const bool isSoft = std::any_of(record.results.begin(), record.results.end(),
                                  [](const auto& result) { return !result.shares.empty(); });
  using enum compare::MetricKind;
  addValues(table, compare::namesOf(isSoft ? compare::allMetrics()
                                           : compare::metricsOfKinds({rate, boundary, length})));
  for (const study::ResultRecord& result : record.results) {
    Row row{{textCell(record.name), textCell(result.method), textCell(result.light),
             textCell(result.view), textCell(std::string(study::answerName(result.answer))),
             textCell(result.region)}};
    appendCounts(row, result.counts);
    for (const compare::Metric& metric : study::metricsOf(result))
      row.cells.push_back(valueCell(metric.value));
    row.cells.resize(table.columns.size(), valueCell(std::nullopt));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table binsTable(const study::StudyRecord& record) {
  Table table{.kind = "bins", .columns = {}};
  addTexts(table, {"study", "method", "view", "light", "axis"});
  addValues(table, std::array{"low", "high"});
  addValues(table, countNames);
  addValues(table, compare::namesOf(binRates));
  for (const study::BinRecord& bin : record.bins) {
    Row row{{textCell(record.name), textCell(bin.method), textCell(bin.view), textCell(bin.light),
             textCell(bin.axis), valueCell(bin.low), valueCell(bin.high)}};
    appendCounts(row, bin.counts);
    for (const compare::MetricId id : binRates)
      row.cells.push_back(valueCell(compare::rate(bin.counts, id).value));
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::vector<Table> binErrorTables(const study::StudyRecord& record) {
  using Bins = std::vector<const study::BinRecord*>;
  std::map<std::pair<std::string, std::string>, Bins> groups;
  for (const study::BinRecord& bin : record.bins) {
    if (bin.light == study::allLights) groups[{bin.axis, bin.view}].push_back(&bin);
  }
  const auto errorOf = [](const study::BinRecord& bin) {
    return compare::rate(bin.counts, compare::metrics::errorRate);
  };
  std::vector<Table> tables;
  for (const auto& [group, bins] : groups) {
    std::vector<BinEnds> ends;
    double worst = 0;
    for (const study::BinRecord* bin : bins) {
      appendOnce(ends, BinEnds{bin->low, bin->high});
      worst = std::max(worst, errorOf(*bin).value.value_or(0));
    }
    if (ends.size() < 2) continue;
    std::sort(ends.begin(), ends.end());
    Table table{.kind = "regions",
                .title = fmt::format("Error by {} ({})", axisTitle(group.first), group.second),
                .columns = {{"Method", "method", Quantity::name}}};
    for (const auto& [low, high] : ends)
      table.columns.push_back({binText(low, high), "", Quantity::percent});
    for (const std::string& method : study::methodsOf(record)) {
      Row row{{textCell(method)}};
      for (const BinEnds& place : ends) {
        const auto bin = std::find_if(bins.begin(), bins.end(), [&](const study::BinRecord* one) {
          return one->method == method && BinEnds{one->low, one->high} == place;
        });
        if (bin == bins.end()) {
          row.cells.push_back(valueCell({}, "no sample"));
          continue;
        }
        const compare::Metric error = errorOf(**bin);
        row.cells.push_back(error.value ? heatCell(*error.value, worst,
                                                   groupedText((*bin)->counts.samples) + " samples")
                                        : metricCell(error));
      }
      table.rows.push_back(std::move(row));
    }
    tables.push_back(std::move(table));
  }
  return tables;
}

namespace {

Cell verdictCell(const study::Judgement& judgement) {
  Cell cell = textCell(gateVerdictName(judgement.verdict));
  cell.emphasis = judgement.isFault() ? Emphasis::bad : Emphasis::good;
  return cell;
}

/// "undefined" with the reason for whoever points at it.
Cell gateValueCell(const std::optional<double>& value, const std::string& reason) {
  Cell cell = valueCell(value, value ? exactText(*value) : reason);
  cell.text = value ? fmt::format("{:.4g}", *value) : "undefined";
  return cell;
}

Cell changeCell(const study::Judgement& judgement, std::optional<double> committed) {
  if (!judgement.value || !committed) return {};
  Cell cell = valueCell(*judgement.value - *committed);
  cell.text = fmt::format("{:+.3g}", *cell.value);
  return cell;
}

}  // namespace

Table gateTable(std::span<const study::Judgement> judgements) {
  using Q = Quantity;
  const study::Gate& first = judgements.front().gate;
  const bool isReference = study::committedValue(first).has_value();
  // All references are of the region of all samples.
  const unsigned forReferences = isReference ? byAll : 0U;
  const unsigned forThresholds = isReference ? 0U : byAll;
  Table table{.kind = gateOriginName(first) + "s",
              .columns = {{"", "verdict"},
                          {"Method", "method"},
                          {"View", "view"},
                          {"Light", "light"},
                          {"Region", "region", Q::text, forThresholds},
                          {"Metric", "metric"},
                          {"Committed", "committed", Q::exact, forReferences},
                          {"Value", "value", Q::exact},
                          {"Change", "change", Q::exact, forReferences},
                          {"Limit", "limit", Q::exact}}};
  for (const study::Judgement& judgement : judgements) {
    const study::Gate& gate = judgement.gate;
    const std::optional<double> committed = study::committedValue(gate);
    table.rows.push_back(
        {{verdictCell(judgement), textCell(gate.method), textCell(gate.view), textCell(gate.light),
          textCell(gate.region), textCell(std::string(gate.metric.name())),
          gateValueCell(committed, ""), gateValueCell(judgement.value, judgement.reason),
          changeCell(judgement, committed), textCell(limitText(gate))}});
  }
  return table;
}

Table flipTable(const std::vector<study::UncertaintyRecord>& flips) {
  Table table{.kind = "flips",
              .columns = {{"View", "view"},
                          {"Light", "light"},
                          {"Samples that change", "flip_rate", Quantity::percent}}};
  for (const study::UncertaintyRecord& flip : flips) {
    table.rows.push_back({{textCell(flip.view), textCell(flip.light), valueCell(flip.flipRate)}});
  }
  return table;
}

Table timingTable(const std::vector<study::TimingRecord>& timings) {
  Table table{.kind = "timings",
              .columns = {{"Stage", "stage"}, {"Seconds", "seconds", Quantity::decimals}}};
  for (const study::TimingRecord& timing : timings) {
    table.rows.push_back({{textCell(timing.stage), valueCell(timing.seconds)}});
  }
  return table;
}

Table inputTable(const std::vector<study::InputRecord>& inputs) {
  Table table{
      .kind = "inputs",
      .columns = {{"Kind", "kind"}, {"File", "file"}, {"SHA-256", "sha256", Quantity::code}}};
  for (const study::InputRecord& input : inputs) {
    table.rows.push_back({{textCell(std::string(inputKindName(input.kind))), textCell(input.file),
                           textCell(input.sha256)}});
  }
  return table;
}

}  // namespace gnomon::report
