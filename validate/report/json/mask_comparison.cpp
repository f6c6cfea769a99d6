#include "report/json/mask_comparison.h"

#include <fmt/core.h>

#include <algorithm>

#include "common/error.h"
#include "compare/counts.h"
#include "compare/metric.h"
#include "report/json/json_values.h"
#include "report/tables/confidence.h"
#include "report/terminal_page.h"
#include "report/text/number_text.h"

namespace gnomon::report {

namespace {

std::size_t countOf(const Mask& mask, Shade shade) {
  return static_cast<std::size_t>(std::count(mask.samples.begin(), mask.samples.end(), shade));
}

Json fileJson(const MaskFileRecord& file) {
  return {{"file", file.file},
          {"lit", file.lit},
          {"shadowed", file.shadowed},
          {"none", file.none},
          {"binarised", file.binarised}};
}

std::string fileLine(const char* what, const MaskFileRecord& file) {
  std::string text = fmt::format("{}: {} lit, {} shadowed", what, groupedText(file.lit),
                                 groupedText(file.shadowed));
  if (file.none > 0) text += fmt::format(", {} without a sample", groupedText(file.none));
  if (file.binarised > 0) text += fmt::format("; {} by the threshold", groupedText(file.binarised));
  return text;
}

std::string pixelsLine(const MaskComparison& c) {
  std::string text =
      fmt::format("{} × {} pixels: {} compared", c.width, c.height, groupedText(c.counts.samples));
  if (c.withoutSample > 0)
    text += fmt::format(", {} without a sample", groupedText(c.withoutSample));
  if (c.outsideRoi > 0) {
    text += fmt::format(", {} outside the region of interest", groupedText(c.outsideRoi));
  }
  if (c.isSoft) text += ", by their shares of light; boundaries where these are cut at 0.5";
  return text;
}

std::string countsLine(const compare::Counts& counts) {
  const auto pixels = [](double cell) { return groupedText(static_cast<std::uint64_t>(cell)); };
  return fmt::format("shadowed in both {}, false shadow {}, false light {}, lit in both {}",
                     pixels(counts.truePositive), pixels(counts.falsePositive),
                     pixels(counts.falseNegative), pixels(counts.trueNegative));
}

/// With so many significant digits, a share in percent; a value that is not 1 never looks so.
std::string figureText(double value, compare::MetricId metric, int digits) {
  if (metric.unit() != compare::MetricUnit::share)
    return fmt::format("{:.{}g}", requireFinite(value, metric.name()), digits);
  const std::string text =
      fmt::format("{:.{}g}", 100 * requireFinite(value, metric.name()), digits);
  return (text == "100" && value != 1 ? exactText(100 * value) : text) + " %";
}

std::string intervalLine(const compare::ConfidenceInterval& confidence) {
  if (!confidence.interval) return fmt::format("No interval of the error: {}.", confidence.reason);
  return fmt::format("The error's 95 % interval: {} %, from {} blocks.",
                     intervalText(confidence.interval), groupedText(confidence.blocks));
}

Table metricsFound(const std::vector<compare::Metric>& metrics) {
  Table table{.kind = "metrics",
              .columns = {{"Metric", "metric", Quantity::name},
                          {"Value", "value", Quantity::exact},
                          {"", "reason"}}};
  table.columns[0].width = 18;
  table.columns[1].width = 12;
  for (const compare::Metric& metric : metrics) {
    Row row{{textCell(std::string(metric.name())), metricCell(metric),
             textCell(std::string(metric.reason))}};
    if (metric.value) row.cells[1].text = figureText(*metric.value, metric.id, 6);
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string failureText(const study::Judgement& judgement) {
  const study::Gate& gate = judgement.gate;
  constexpr int digits = 12;  // a value and the limit that it misses differ in them
  const auto figure = [&](double value) { return figureText(value, gate.metric, digits); };
  std::string text =
      fmt::format("{} is {}", gate.metric.name(),
                  judgement.value ? figure(*judgement.value) : "undefined: " + judgement.reason);
  if (gate.maximum) text += fmt::format(", at most {} allowed", figure(*gate.maximum));
  if (gate.minimum) text += fmt::format(", at least {} required", figure(*gate.minimum));
  return text;
}

/// samples, tp, fp, fn, tn.
void addCounts(Json& json, const compare::Counts& counts) {
  json["samples"] = counts.samples;
  json["tp"] = jsonNumber(counts.truePositive, "tp");
  json["fp"] = jsonNumber(counts.falsePositive, "fp");
  json["fn"] = jsonNumber(counts.falseNegative, "fn");
  json["tn"] = jsonNumber(counts.trueNegative, "tn");
}

Json jsonConfidence(const compare::ConfidenceInterval& confidence) {
  return {{"low", jsonNumber(lowOf(confidence.interval), "confidence.low")},
          {"high", jsonNumber(highOf(confidence.interval), "confidence.high")},
          {"reason", jsonReason(std::string(confidence.reason))},
          {"blocks", confidence.blocks}};
}

Json jsonComparison(const MaskComparison& c) {
  Json json = {{"candidate", fileJson(c.candidate)},
               {"truth", fileJson(c.truth)},
               {"roi", c.roi ? fileJson(*c.roi) : Json(nullptr)},
               {"width", c.width},
               {"height", c.height},
               {"without_sample", c.withoutSample},
               {"outside_roi", c.outsideRoi}};
  if (c.isSoft) json["shares"] = true;
  addCounts(json, c.counts);
  addMetrics(json, c.metrics);
  json["confidence"] = jsonConfidence(c.confidence);
  json["uncertainty"] = jsonNumber(c.uncertainty, "uncertainty");
  json["notices"] = c.notices;
  json["gates"] = jsonList(c.judgements, jsonJudgement);
  return json;
}

/// "error_rate is 12.5 %, at most 10 % allowed", of each gate that fails.
std::vector<std::string> failureTexts(const std::vector<study::Judgement>& judgements) {
  std::vector<std::string> texts;
  for (const study::Judgement& judgement : judgements) {
    if (judgement.isFault()) texts.push_back(failureText(judgement));
  }
  return texts;
}

}  // namespace

MaskFileRecord::MaskFileRecord(std::string name, const Mask& mask, std::size_t soft)
    : file(std::move(name)),
      lit(countOf(mask, Shade::lit)),
      shadowed(countOf(mask, Shade::shadowed)),
      none(countOf(mask, Shade::none)),
      binarised(soft) {}

bool MaskComparison::passed() const {
  return std::none_of(judgements.begin(), judgements.end(),
                      [](const study::Judgement& judgement) { return judgement.isFault(); });
}

std::string uncertaintyText(double share) {
  return fmt::format("The truth is uncertain by {} % of the pixels: smaller errors mean nothing.",
                     percentText(share));
}

std::string maskComparisonJson(const MaskComparison& c) {
  Json json = {{"schema", "gnomon-comparison/1"},
               {"status", jsonStatus(c.passed() ? study::RunStatus::pass : study::RunStatus::fail)},
               {"command", c.command}};
  json.update(jsonComparison(c));
  return jsonText(json);
}

std::string maskComparisonTable(const MaskComparison& c, bool colours) {
  TerminalPage page(colours);
  page.heading(fmt::format("{} against {}", c.candidate.file, c.truth.file));
  page.paragraph(fileLine("Candidate", c.candidate));
  page.paragraph(fileLine("Truth", c.truth));
  page.paragraph(pixelsLine(c));
  page.paragraph(countsLine(c.counts));
  page.notices(c.notices);
  page.blank();
  appendTable(page, metricsFound(c.metrics));
  page.blank();
  page.paragraph(intervalLine(c.confidence));
  if (c.uncertainty) page.paragraph(uncertaintyText(*c.uncertainty));
  page.met("Gates", c.judgements.size(), failureTexts(c.judgements));
  return page.text();
}

namespace {

Row rowOf(const std::string& name, const compare::Counts& counts,
          const compare::ConfidenceInterval& confidence, std::optional<double> uncertainty) {
  return {{textCell(name), countCell(counts.samples),
           metricCell(compare::rate(counts, compare::metrics::errorRate)),
           intervalCell(confidence.interval),
           metricCell(compare::rate(counts, compare::metrics::falseShadow)),
           metricCell(compare::rate(counts, compare::metrics::falseLight)),
           valueCell(uncertainty)}};
}

Table pairsTable(const MaskFolders& folders) {
  using Q = Quantity;
  Table table{.kind = "masks",
              .columns = {{"Mask", "mask", Q::name},
                          {"Pixels", "samples", Q::count},
                          {"Error %", "error_rate", Q::percent},
                          {"95 %", "", Q::interval},
                          {"Shadow", "false_shadow", Q::percent},
                          {"Light", "false_light", Q::percent},
                          {"Truth ±", "uncertainty", Q::percent}}};
  for (const auto& [name, c] : folders.pairs) {
    table.rows.push_back(rowOf(name, c.counts, c.confidence, c.uncertainty));
  }
  table.rows.push_back(rowOf(fmt::format("all {}", folders.pairs.size()), folders.counts(),
                             folders.confidence, folders.uncertainty()));
  return table;
}

/// The notices of all pairs, each with its name.
std::vector<std::string> noticesOf(const MaskFolders& folders) {
  std::vector<std::string> notices;
  for (const auto& [name, c] : folders.pairs) {
    for (const std::string& notice : c.notices) notices.push_back(name + ": " + notice);
  }
  return notices;
}

Json pairJson(const MaskPair& pair) {
  Json json = {{"name", pair.name}};
  json.update(jsonComparison(pair.comparison));
  return json;
}

}  // namespace

bool MaskFolders::passed() const {
  return std::all_of(pairs.begin(), pairs.end(),
                     [](const MaskPair& pair) { return pair.comparison.passed(); });
}

compare::Counts MaskFolders::counts() const {
  compare::Counts sum;
  for (const MaskPair& pair : pairs) sum += pair.comparison.counts;
  return sum;
}

std::optional<double> MaskFolders::uncertainty() const {
  double uncertain = 0;
  double all = 0;
  for (const auto& [name, c] : pairs) {
    if (!c.uncertainty) return std::nullopt;
    const auto samples = static_cast<double>(c.counts.samples);
    uncertain += *c.uncertainty * samples;
    all += samples;
  }
  return uncertain / all;
}

std::string maskFoldersJson(const MaskFolders& folders) {
  Json all = Json::object();
  addCounts(all, folders.counts());
  addMetrics(all, compare::rates(folders.counts()));
  all["confidence"] = jsonConfidence(folders.confidence);
  all["uncertainty"] = jsonNumber(folders.uncertainty(), "uncertainty");
  return jsonText(
      {{"schema", "gnomon-comparisons/1"},
       {"status", jsonStatus(folders.passed() ? study::RunStatus::pass : study::RunStatus::fail)},
       {"command", folders.command},
       {"candidate", folders.candidate},
       {"truth", folders.truth},
       {"all", all},
       {"pairs", jsonList(folders.pairs, pairJson)}});
}

std::string maskFoldersTable(const MaskFolders& folders, bool colours) {
  TerminalPage page(colours);
  page.heading(fmt::format("{} against {}", folders.candidate, folders.truth));
  page.paragraph(
      "Percent of the pixels. Shadow, light: what is falsely shadowed, falsely lit. 95 %: the "
      "interval of the error. Truth ±: its uncertainty; smaller errors mean nothing.");
  page.notices(noticesOf(folders));
  page.blank();
  appendTable(page, pairsTable(folders));
  page.blank();
  if (!folders.confidence.interval) {
    page.paragraph(fmt::format("No interval over all: {}.", folders.confidence.reason));
  }
  std::size_t gates = 0;
  std::vector<std::string> failed;
  for (const auto& [name, c] : folders.pairs) {
    gates += c.judgements.size();
    for (const std::string& text : failureTexts(c.judgements)) {
      failed.push_back(fmt::format("{}: {}", name, text));
    }
  }
  page.met("Gates", gates, failed);
  return page.text();
}

}  // namespace gnomon::report
