#include "report/tables/budget_files.h"

#include <vector>

#include "report/tables/csv_text.h"
#include "report/text/interval_text.h"
#include "report/text/number_text.h"

namespace gnomon {
namespace {

std::string partLine(const BudgetRecord& budget, const std::string& part,
                     const BudgetShare& forward, const BudgetShare& backward) {
  std::vector<std::string> cells = {budget.method, budget.view, budget.light, part};
  for (const BudgetShare* share : {&forward, &backward}) {
    cells.push_back(exactText(share->value));
    cells.push_back(exactText(lowOf(share->interval)));
    cells.push_back(exactText(highOf(share->interval)));
    cells.emplace_back(share->distinguishable ? "1" : "0");
  }
  cells.push_back(exactText(budget.uncertainty));
  return csvLine(cells);
}

}  // namespace

std::string budgetCsv(const StudyRecord& record) {
  std::string csv = csvLine({"method", "view", "light", "part", "forward", "forward_low",
                             "forward_high", "forward_distinguishable", "backward", "backward_low",
                             "backward_high", "backward_distinguishable", "uncertainty"});
  for (const BudgetRecord& budget : record.budgets) {
    csv += partLine(budget, "total", budget.total, budget.total);
    for (const BudgetCause& cause : budget.causes) {
      csv += partLine(budget, cause.name, cause.forward, cause.backward);
    }
    csv += partLine(budget, "distant", budget.distant, budget.distant);
    csv += partLine(budget, "other", budget.other, budget.other);
  }
  return csv;
}

}  // namespace gnomon
