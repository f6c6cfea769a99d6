#include "report/page/budget_html.h"

#include <vector>

#include "report/page/html_page.h"
#include "report/tables/budget_table.h"
#include "report/tables/formats/html_format.h"
#include "report/text/budget_text.h"

namespace gnomon {

Html budgetSection(const StudyRecord& record, std::span<const DrawnPlot> plots) {
  if (record.budgets.empty()) return {};
  std::vector<const DrawnPlot*> own;  // one a light
  for (const DrawnPlot& plot : plots) {
    if (plot.sheet.section == "budget") own.push_back(&plot);
  }
  Html content = htmlNote(budgetNote(record.budgets.front()));
  const std::vector<std::string> lights = budgetLights(record);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    Html part = i < own.size() ? htmlPlot(*own[i]) : Html();
    for (const BudgetRecord& budget : budgetsOf(record, lights[i])) {
      part += html("<h3>{}</h3>\n{}{}", budget.method, htmlNote(orderText(budget)),
                   htmlTable(budgetTable(budget)));
    }
    content +=
        i == 0 ? part : html("<details><summary>{}</summary>\n{}</details>\n", lights[i], part);
  }
  return htmlSection("budget", "Where the error comes from", content);
}

}  // namespace gnomon
