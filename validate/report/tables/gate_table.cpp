#include "report/tables/gate_table.h"

#include <fmt/core.h>

#include "report/text/gate_text.h"
#include "report/text/number_text.h"

namespace gnomon::report {
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

}  // namespace gnomon::report
