#include "report/json/mask_folders.h"

#include <fmt/core.h>

#include <algorithm>

#include "compare/rates.h"
#include "report/tables/formats/terminal_format.h"
#include "report/text/number_text.h"
#include "report/text/terminal_page.h"

namespace gnomon::report {
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
