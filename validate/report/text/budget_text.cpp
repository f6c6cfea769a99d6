#include "report/text/budget_text.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "common/lists.h"
#include "report/text/interval_text.h"
#include "report/text/number_text.h"
#include "study/run/stages/budget.h"

namespace gnomon::report {

std::string restName(std::string_view rest) {
  return fmt::format("left: {}", rest);
}

std::string budgetNote(const study::BudgetRecord& budget, bool isSoft) {
  return fmt::format(
      "Percent of {} of view {}, {}. A cause’s share is the error before the cause is "
      "corrected minus the error after. Causes are corrected in the order of the list (forward) or "
      "from its end (backward), each time starting from the published method. A share below zero: "
      "the correction made the error larger. {} It comes from {} blocks. ≈ not distinguishable "
      "from zero: the interval contains 0, or the share is within the truth’s uncertainty of {} %; "
      "= no answer changed; ? no interval. What is left is split by region, each sample in the "
      "first that it is "
      "in: "
      "{}.",
      errorWhole(isSoft), budget.view,
      budget.light == "all" ? "mean over all lights" : budget.light, intervalMeaning, budget.blocks,
      percentText(budget.uncertainty), fmt::join(study::budgetRestNames(), ", "));
}

std::string orderText(const study::BudgetRecord& budget, bool isSoft) {
  const double moved = study::orderDependence(budget);
  if (!(budget.total.value > 0)) return "No error to attribute.";
  return fmt::format(
      "{} % wrong. The two orders assign {} % of {}, {:.0f} % of the error, to different "
      "causes.",
      percentText(budget.total.value), percentText(moved), errorWhole(isSoft),
      100 * moved / budget.total.value);
}

std::vector<std::string> budgetLights(const study::StudyRecord& record) {
  std::vector<std::string> lights;
  for (const study::BudgetRecord& budget : record.budgets) {
    appendOnce(lights, budget.light);
  }
  return lights;
}

std::vector<study::BudgetRecord> budgetsOf(const study::StudyRecord& record,
                                           const std::string& light) {
  std::vector<study::BudgetRecord> budgets;
  for (const study::BudgetRecord& budget : record.budgets) {
    if (budget.light == light) budgets.push_back(budget);
  }
  return budgets;
}

}  // namespace gnomon::report
