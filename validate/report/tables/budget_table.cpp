#include "report/tables/budget_table.h"

#include "report/text/confidence_text.h"
#include "report/text/number_text.h"
#include "report/text/ranking_text.h"

namespace gnomon::report {
namespace {

void appendShare(Row& row, const study::BudgetShare& share) {
  const bool isSure = study::isDistinguishable(share.verdict);
  Cell cell =
      valueCell(share.value, isSure ? "" : std::string(differenceVerdictName(share.verdict)));
  cell.emphasis = isSure ? Emphasis::strong : Emphasis::quiet;
  cell.mark = differenceSign(share.verdict);
  row.cells.push_back(std::move(cell));
  row.cells.push_back(intervalCell(share.interval, share.reason));
}

Row budgetRow(const std::string& name, const study::BudgetShare& forward,
              const study::BudgetShare& backward) {
  Row row{{textCell(name)}};
  appendShare(row, forward);
  appendShare(row, backward);
  return row;
}

Row causeRow(const study::BudgetCause& cause) {
  Row row = budgetRow(cause.name, cause.forward, cause.backward);
  if (!cause.change.empty()) row.cells.front().note = "→ " + cause.change;
  row.cells.push_back(valueCell(cause.backward.value - cause.forward.value));
  return row;
}

/// What both orders give alike.
Row restRow(const std::string& name, const study::BudgetShare& share) {
  Row row = budgetRow(name, share, share);
  row.cells.push_back(textCell(""));
  return row;
}

Row partRow(const study::BudgetRecord& budget, const std::string& part,
            const study::BudgetShare& forward, const study::BudgetShare& backward) {
  Row row{{textCell(budget.method), textCell(budget.view), textCell(budget.light), textCell(part)}};
  for (const study::BudgetShare* share : {&forward, &backward}) {
    row.cells.push_back(valueCell(share->value));
    row.cells.push_back(intervalCell(share->interval));
    row.cells.push_back(flagCell(study::isDistinguishable(share->verdict)));
  }
  row.cells.push_back(valueCell(budget.uncertainty));
  return row;
}

}  // namespace

Table budgetTable(const study::BudgetRecord& budget) {
  using Q = Quantity;
  Table table{.kind = "budget",
              .columns = {{"Cause", "cause", Q::name},
                          {"Forward", "forward", Q::signedPercent},
                          {"95 %", "forward", Q::interval},
                          {"Backward", "backward", Q::signedPercent},
                          {"95 %", "backward", Q::interval},
                          {"Difference", "difference", Q::signedPercent, byAll & ~onTerminal}}};
  table.columns[0].width = 38;
  for (const std::size_t i : {1U, 3U}) table.columns[i].markWidth = 2;
  for (const study::BudgetCause& cause : budget.causes) table.rows.push_back(causeRow(cause));
  for (const study::BudgetRest& rest : budget.rest) {
    table.rows.push_back(restRow(restName(rest.name), rest.share));
  }
  table.rows.push_back(restRow("all of the error", budget.total));
  return table;
}

Table budgetPartsTable(const study::StudyRecord& record) {
  using Q = Quantity;
  Table table{.kind = "budget",
              .columns = {{"method"},
                          {"view"},
                          {"light"},
                          {"part"},
                          {"forward", "", Q::exact},
                          {"95 %", "forward", Q::interval},
                          {"forward_distinguishable", "", Q::exact},
                          {"backward", "", Q::exact},
                          {"95 %", "backward", Q::interval},
                          {"backward_distinguishable", "", Q::exact},
                          {"uncertainty", "", Q::exact}}};
  for (const study::BudgetRecord& budget : record.budgets) {
    table.rows.push_back(partRow(budget, "total", budget.total, budget.total));
    for (const study::BudgetCause& cause : budget.causes) {
      table.rows.push_back(partRow(budget, cause.name, cause.forward, cause.backward));
    }
    for (const study::BudgetRest& rest : budget.rest) {
      table.rows.push_back(partRow(budget, rest.name, rest.share, rest.share));
    }
  }
  return table;
}

}  // namespace gnomon::report
