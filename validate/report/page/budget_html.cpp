#include "report/page/budget_html.h"

#include <fmt/core.h>

#include <span>
#include <vector>

#include "report/page/html_page.h"
#include "report/plots/budget_bars.h"
#include "report/tables/html_cells.h"
#include "report/text/budget_text.h"
#include "report/text/html_text.h"
#include "report/text/interval_text.h"
#include "report/text/number_text.h"
#include "study/run/stages/budget.h"

namespace gnomon {
namespace {

std::string shareCells(const BudgetShare& share) {
  const std::string value = signedPercent(share.value);
  return numberCell(share.distinguishable ? "<b>" + value + "</b>"
                                          : fmt::format("<span class=\"quiet\">{} ≈</span>", value),
                    share.distinguishable ? "" : "not distinguishable from none") +
         numberCell(fmt::format("<small>{}</small>", intervalText(share.interval)), share.reason);
}

std::string numberedCell(std::size_t number, const std::string& name, const std::string& change) {
  const std::string after =
      change.empty() ? "" : fmt::format("<small class=\"same\">→ {}</small>", escapeHtml(change));
  return fmt::format("<td class=\"rank\">{}</td><td class=\"method\">{}{}</td>", number,
                     escapeHtml(name), after);
}

std::size_t numberOf(const std::vector<BudgetPart>& parts, const std::string& name) {
  std::size_t number = 1;
  for (const BudgetPart& part : parts) {
    if (part.name == name) return number;
    ++number;
  }
  return number;
}

std::string causeRow(const BudgetCause& cause, std::size_t number) {
  return fmt::format("<tr>{}{}{}{}</tr>\n", numberedCell(number, cause.name, cause.change),
                     shareCells(cause.forward), shareCells(cause.backward),
                     numberCell(signedPercent(cause.backward.value - cause.forward.value)));
}

std::string restRow(const BudgetShare& share, const BudgetPart& part, std::size_t number) {
  return fmt::format("<tr>{}{}{}{}</tr>\n", numberedCell(number, part.name, ""), shareCells(share),
                     shareCells(share), numberCell(""));
}

std::string budgetTable(const BudgetRecord& budget, const std::vector<BudgetPart>& parts) {
  std::string body;
  for (const BudgetCause& cause : budget.causes) {
    body += causeRow(cause, numberOf(parts, cause.name));
  }
  body += restRow(budget.distant, parts[parts.size() - 2], parts.size() - 1);
  body += restRow(budget.other, parts.back(), parts.size());
  body += fmt::format("<tr><td></td><td class=\"method\"><b>all of the error</b></td>{}{}{}</tr>\n",
                      shareCells(budget.total), shareCells(budget.total), numberCell(""));
  return fmt::format("<h3>{}</h3>\n<p class=\"note\">{}</p>\n", escapeHtml(budget.method),
                     escapeHtml(orderText(budget))) +
         htmlTable("budget",
                   headCells({"", "Cause"}, {"Forward", "95 %", "Backward", "95 %", "Difference"}),
                   body);
}

/// The budgets of one light, in the order of the record.
std::vector<BudgetRecord> ofLight(const StudyRecord& record, const std::string& light) {
  std::vector<BudgetRecord> budgets;
  for (const BudgetRecord& budget : record.budgets) {
    if (budget.light == light) budgets.push_back(budget);
  }
  return budgets;
}

std::string tables(std::span<const BudgetRecord> budgets, const std::vector<BudgetPart>& parts) {
  std::string html;
  for (const BudgetRecord& budget : budgets) html += budgetTable(budget, parts);
  return html;
}

}  // namespace

std::string budgetSection(const StudyRecord& record) {
  if (record.budgets.empty()) return "";
  const BudgetRecord& first = record.budgets.front();
  const std::vector<BudgetPart> parts = budgetParts(record.budgets);
  const std::vector<BudgetRecord> main = ofLight(record, first.light);
  std::string html = fmt::format("<p class=\"note\">{}</p>\n", escapeHtml(budgetNote(first))) +
                     budgetBars(main, parts) + budgetKey(parts) + tables(main, parts);
  for (const std::string& light : budgetLights(record)) {
    if (light == first.light) continue;
    const std::vector<BudgetRecord> budgets = ofLight(record, light);
    html += fmt::format("<details><summary>{}</summary>\n", escapeHtml(light)) +
            budgetBars(budgets, parts) + tables(budgets, parts) + "</details>\n";
  }
  return htmlSection("budget", "Where the error comes from", html);
}

}  // namespace gnomon
