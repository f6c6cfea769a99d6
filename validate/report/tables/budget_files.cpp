#include "report/tables/budget_files.h"

#include <vector>

#include "report/tables/csv_text.h"
#include "report/text/interval_text.h"
#include "report/text/number_text.h"
#include "study/run/stages/budget.h"

namespace gnomon {
namespace {

Json shareJson(const BudgetShare& share) {
  return {{"share", jsonNumber(share.value, "budget.share")},
          {"low", jsonNumber(lowOf(share.interval), "budget.low")},
          {"high", jsonNumber(highOf(share.interval), "budget.high")},
          {"reason", jsonReason(share.reason)},
          {"distinguishable", share.distinguishable}};
}

Json causeJson(const BudgetCause& cause) {
  return {{"cause", cause.name},
          {"change", cause.change},
          {"forward", shareJson(cause.forward)},
          {"backward", shareJson(cause.backward)}};
}

Json stateJson(const BudgetState& state) {
  return {{"error_rate", jsonNumber(state.errorRate, "budget.error_rate")},
          {"false_shadow", jsonNumber(state.falseShadow, "budget.false_shadow")},
          {"false_light", jsonNumber(state.falseLight, "budget.false_light")}};
}

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

Json jsonBudget(const BudgetRecord& budget) {
  return {{"method", budget.method},
          {"view", budget.view},
          {"light", budget.light},
          {"uncertainty", jsonNumber(budget.uncertainty, "budget.uncertainty")},
          {"blocks", budget.blocks},
          {"order_dependence", jsonNumber(orderDependence(budget), "budget.order_dependence")},
          {"total", shareJson(budget.total)},
          {"causes", jsonList(budget.causes, causeJson)},
          {"distant", shareJson(budget.distant)},
          {"other", shareJson(budget.other)},
          {"forward_states", jsonList(budget.forward, stateJson)},
          {"backward_states", jsonList(budget.backward, stateJson)}};
}

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
