#include "report/json/mask_comparison.h"

#include <fmt/core.h>

#include <algorithm>

#include "common/error.h"
#include "compare/metric_range.h"
#include "report/tables/formats/terminal_format.h"
#include "report/text/interval_text.h"
#include "report/text/number_text.h"
#include "report/text/terminal_page.h"

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

std::string uncertaintyText(double share) {
  return fmt::format("The truth is uncertain by {} % of the pixels: smaller errors mean nothing.",
                     percentText(share));
}

std::vector<std::string> failureTexts(const std::vector<study::Judgement>& judgements) {
  std::vector<std::string> texts;
  for (const study::Judgement& judgement : judgements) {
    if (judgement.isFault()) texts.push_back(failureText(judgement));
  }
  return texts;
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

}  // namespace gnomon::report
