#include "report/tables/terminal_budget.h"

#include <fmt/core.h>

#include <string>

#include "report/text/budget_text.h"
#include "report/text/interval_text.h"
#include "report/text/number_text.h"
#include "report/text/text_width.h"

namespace gnomon {
namespace {

constexpr std::size_t shareWidth = 11;
constexpr std::size_t budgetNameWidth =
    terminalWidth - terminalIndent - 2 * (shareWidth + markWidth + intervalWidth);

std::string rowText(const std::string& name, const std::string& cells) {
  return std::string(terminalIndent, ' ') + fitLeft(name, budgetNameWidth) + cells;
}

std::string shareColumns(const BudgetShare& share) {
  return fitRight(signedPercent(share.value), shareWidth) +
         fitLeft(share.distinguishable ? "" : " ≈", markWidth) +
         fitRight(intervalText(share.interval), intervalWidth);
}

std::string head() {
  std::string cells;
  for (const char* order : {"forward", "backward"}) {
    cells +=
        fitRight(order, shareWidth) + std::string(markWidth, ' ') + fitRight("95 %", intervalWidth);
  }
  return rowText("cause", cells);
}

void appendBudget(TerminalPage& page, const BudgetRecord& budget) {
  page.blank();
  page.paragraph(budget.method + ": " + orderText(budget));
  page.line(head());
  for (const BudgetCause& cause : budget.causes) {
    page.line(rowText(cause.name, shareColumns(cause.forward) + shareColumns(cause.backward)));
  }
  page.line(rowText("left: distant occluders", shareColumns(budget.distant)));
  page.line(rowText("left: other", shareColumns(budget.other)));
}

}  // namespace

void appendBudgets(TerminalPage& page, const StudyRecord& record) {
  if (record.budgets.empty()) return;
  const BudgetRecord& first = record.budgets.front();
  page.blank();
  page.heading("Where the error comes from");
  page.paragraph(budgetNote(first));
  for (const BudgetRecord& budget : record.budgets) {
    if (budget.light == first.light) appendBudget(page, budget);
  }
}

}  // namespace gnomon
