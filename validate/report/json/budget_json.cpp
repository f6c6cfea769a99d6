#include "report/json/budget_json.h"

#include "report/text/interval_text.h"
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

}  // namespace gnomon
