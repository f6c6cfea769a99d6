#include "report/tables/html_tables.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "common/system/memory.h"
#include "compare/rates.h"
#include "report/plots/error_bars.h"
#include "report/tables/cost.h"
#include "report/tables/html_cells.h"
#include "report/text/budget_text.h"
#include "report/text/gate_text.h"
#include "report/text/html_text.h"
#include "report/text/interval_text.h"
#include "report/text/number_text.h"
#include "report/text/ranking_text.h"
#include "report/text/refinement_text.h"
#include "study/judge/distinguish.h"
#include "study/record/result_metrics.h"

namespace gnomon {
namespace {

std::string metricCell(const Metric& metric) {
  return numberCell(rateText(metric.value), metric.reason);
}

/// "≈ a, b and 2 more", or nothing.
std::string indistinguishableText(const std::vector<std::string>& labels) {
  if (labels.empty()) return "";
  constexpr std::size_t shown = 3;
  std::string names;
  for (std::size_t i = 0; i < std::min(shown, labels.size()); ++i) {
    // Labels may hold commas.
    names += (i > 0 ? "; " : "") + escapeHtml(labels[i]);
  }
  if (labels.size() > shown) names += fmt::format(" and {} more", labels.size() - shown);
  return fmt::format("<small class=\"same\">not distinguishable from {}</small>", names);
}

/// How many cases a mean leaves out, where it does.
std::string meanCell(const Mean& mean, std::size_t cases) {
  if (mean.cases == cases) return numberCell(rateText(mean.value));
  return numberCell(rateText(mean.value),
                    fmt::format("defined in {} of {} cases", mean.cases, cases));
}

std::string rankedRow(const RankedMethod& method, const RankedMethod& best, double scale) {
  const std::string partial =
      method.rank ? ""
                  : fmt::format("<small class=\"same\">{}</small>",
                                escapeHtml(fewerCasesText(method.cases, method.allCases, best.label,
                                                          method.leaderError)));
  return fmt::format(
      "<tr><td class=\"rank\">{}</td><td class=\"method\">{}{}{}{}</td>{}{}{}{}{}{}{}</tr>\n",
      method.rank ? fmt::format("{}", *method.rank) : "–", escapeHtml(method.label),
      errorBar(method, scale), indistinguishableText(method.indistinguishable), partial,
      numberCell("<b>" + withUncertainty(method.errorRate.value, method.uncertainty) + "</b>"),
      numberCell(escapeHtml(intervalText(method.interval)),
                 method.interval ? "" : "no interval was measured"),
      meanCell(method.testError, method.cases), meanCell(method.falseShadow, method.cases),
      meanCell(method.falseLight, method.cases), meanCell(method.iou, method.cases),
      meanCell(method.ber, method.cases));
}

constexpr std::array<std::string_view, 7> caseMetrics = {
    "error_rate", "false_shadow", "false_light", "iou", "f1", "ber", "mcc"};

/// The Matthews correlation is no share: it is shown as it is.
std::string correlationCell(const Metric& metric) {
  return numberCell(escapeHtml(correlationText(metric.value)), metric.reason);
}

/// The median, with the quartiles and the count for whoever points at it.
std::string lengthCell(const ResultRecord& row) {
  const Metric ratio = metricOf(row, "shadow_length_ratio");
  if (!ratio.value) return metricCell(ratio);
  const auto text = [&](std::string_view name) { return ratioText(metricOf(row, name).value); };
  return numberCell(escapeHtml(ratioText(ratio.value)),
                    fmt::format("quartiles {} and {} over {:.0f} runs", text("shadow_length_q1"),
                                text("shadow_length_q3"), row.lengths->runs));
}

std::vector<std::string> indistinguishableIn(const StudyRecord& record, const std::string& method,
                                             const Case& which) {
  std::vector<std::string> labels;
  for (const std::string& other : methodsOf(record)) {
    const auto difference = differenceOf(record, which.view, which.light, method, other);
    if (difference && difference->verdict == DifferenceVerdict::notDistinguishable) {
      labels.push_back(other);
    }
  }
  return labels;
}

std::string caseRow(const StudyRecord& record, const ResultRecord& row, const Case& which) {
  std::string cells =
      fmt::format("<td class=\"method\">{}{}</td>", escapeHtml(row.method),
                  indistinguishableText(indistinguishableIn(record, row.method, which)));
  for (const std::string_view name : caseMetrics) {
    const Metric metric = rate(row.counts, name);
    cells += leastRate(name) < 0 ? correlationCell(metric) : metricCell(metric);
    if (name == "error_rate") {
      cells += numberCell(rateText(rateOf(record, row.method, which, Answer::test, name)));
    }
  }
  return fmt::format("<tr>{}{}</tr>\n", cells, lengthCell(row));
}

std::string regionTooltip(const Counts& counts) {
  return fmt::format("{} samples, false shadow {} %, false light {} %", groupedText(counts.samples),
                     percentText(rate(counts, "false_shadow").value),
                     percentText(rate(counts, "false_light").value));
}

/// @param worst  the table's largest error rate: its cell gets the full shade
std::string regionCell(const ResultRecord* row, double worst) {
  if (row == nullptr) return numberCell("", "not evaluated");
  const Metric error = rate(row->counts, "error_rate");
  if (!error.value) return metricCell(error);
  return heatCell(*error.value, worst, regionTooltip(row->counts));
}

/// The samples of a region, where all methods were asked at the same ones.
std::string regionSamples(const StudyRecord& record, const Case& which, std::string_view region) {
  std::optional<std::size_t> samples;
  for (const std::string& method : methodsOf(record)) {
    const ResultRecord* row = findResult(record, method, which, region);
    if (row == nullptr) continue;
    if (samples && *samples != row->counts.samples) return "differing samples";
    samples = row->counts.samples;
  }
  return samples ? groupedText(*samples) + " samples" : "";
}

}  // namespace

std::string rankingTable(const std::vector<RankedMethod>& ranked) {
  const double scale = errorBarScale(ranked);
  std::string body;
  for (const RankedMethod& method : ranked) body += rankedRow(method, ranked.front(), scale);
  return htmlTable("ranking",
                   headCells({"", "Method"}, {"Error", "95 %", "Test alone", "False shadow",
                                              "False light", "IoU", "BER"}),
                   body);
}

std::string caseTable(const StudyRecord& record, const Case& which) {
  std::string body;
  for (const std::string& method : methodsOf(record)) {
    if (const ResultRecord* row = findResult(record, method, which)) {
      body += caseRow(record, *row, which);
    }
  }
  return htmlTable(
      "metrics",
      headCells({"Method"}, {"Error", "Test alone", "False shadow", "False light", "IoU", "F1",
                             "BER", "MCC<small>−1 to 1</small>", "Shadow length"}),
      body);
}

std::string regionTable(const StudyRecord& record, const Case& which) {
  const std::vector<std::string> regions = regionsOf(record, which);
  if (regions.size() < 2) return "";
  const std::vector<std::string> methods = methodsOf(record);
  std::string head = "<th>Method</th>";
  double worst = 0;
  for (const std::string& region : regions) {
    head += fmt::format("<th class=\"n\">{}<small>{}</small></th>", escapeHtml(region),
                        regionSamples(record, which, region));
    for (const std::string& method : methods) {
      const ResultRecord* row = findResult(record, method, which, region);
      if (row != nullptr) {
        worst = std::max(worst, rate(row->counts, "error_rate").value.value_or(0));
      }
    }
  }
  std::string body;
  for (const std::string& method : methods) {
    if (findResult(record, method, which) == nullptr) continue;
    body += fmt::format("<tr><td class=\"method\">{}</td>", escapeHtml(method));
    for (const std::string& region : regions) {
      body += regionCell(findResult(record, method, which, region), worst);
    }
    body += "</tr>\n";
  }
  return htmlTable("regions", head, body);
}

std::string thresholdTable(std::span<const Judgement> thresholds) {
  std::string body;
  for (const Judgement& judgement : thresholds) {
    const Gate& gate = judgement.gate;
    body += fmt::format("<tr><td><span class=\"tag {}\">{}</span></td>{}{}{}{}{}{}{}</tr>\n",
                        judgement.isFault() ? "failed" : "held", gateVerdictName(judgement.verdict),
                        textCell(gate.method), textCell(gate.view), textCell(gate.light),
                        textCell(gate.region), textCell(gate.metric),
                        gateValueCell(judgement.value, judgement.reason),
                        numberCell(escapeHtml(limitText(gate))));
  }
  return htmlTable(
      "thresholds",
      headCells({"", "Method", "View", "Light", "Region", "Metric"}, {"Value", "Limit"}), body);
}

std::string costTable(const StudyRecord& record) {
  std::string body;
  for (const CostRecord& c : record.cost) {
    const auto bytes = [](std::uint64_t count) { return formatBytes(static_cast<double>(count)); };
    const auto ratio = frameRatio(record, c);
    body += fmt::format(
        "<tr><td class=\"method\">{}</td>{}{}{}{}{}{}</tr>\n", escapeHtml(c.method),
        numberCell(groupedText(c.polygons)), numberCell(bytes(c.tableBytes)),
        numberCell(bytes(c.heightBytes)), numberCell(fmt::format("{}", c.passes)),
        numberCell(frameText(c), c.frameMs ? "" : "not measured"),
        numberCell(timesText(ratio), ratio ? "" : fmt::format("{} was not timed", costReference)));
  }
  return htmlTable("cost",
                   headCells({"Method"}, {"Triangles", "Tables", "Height map", "Passes",
                                          "Frame, ms", "To max-forsyth"}),
                   body);
}

std::string flipTable(const std::vector<UncertaintyRecord>& flips) {
  std::string body;
  for (const UncertaintyRecord& flip : flips) {
    body += fmt::format("<tr>{}{}{}</tr>\n", textCell(flip.view), textCell(flip.light),
                        numberCell(rateText(flip.flipRate)));
  }
  return htmlTable("flips", headCells({"View", "Light"}, {"Samples that flip"}), body);
}

std::string refinementTable(const std::vector<RefinementRecord>& levels) {
  std::string body;
  for (const RefinementRecord& level : levels) {
    body += fmt::format("<tr>{}{}{}</tr>\n", numberCell(stepText(level.stepTexels)),
                        numberCell(groupedText(level.microTriangles)),
                        numberCell(flipText(level.flipRate)));
  }
  return htmlTable(
      "refinement",
      headCells({}, {"Step, texels", "Micro-triangles", "Differ from the level before, %"}), body);
}

std::string timingTable(const std::vector<TimingRecord>& timings) {
  std::string body;
  for (const TimingRecord& timing : timings) {
    body += fmt::format(
        "<tr>{}{}</tr>\n", textCell(timing.stage),
        numberCell(fmt::format("{:.2f}", requireFinite(timing.seconds, "timings.seconds"))));
  }
  return htmlTable("timings", headCells({"Stage"}, {"Seconds"}), body);
}

}  // namespace gnomon
