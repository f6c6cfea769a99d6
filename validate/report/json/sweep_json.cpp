#include "report/json/sweep_json.h"

#include "report/json/json_values.h"
#include "report/tables/cost_table.h"
#include "study/judge/study_ranking.h"
#include "study/spec/sweep.h"

namespace gnomon {
namespace {

Json sweptStudyJson(const SweepRecord& sweep) {
  return {{"name", sweep.name}, {"title", sweep.title},     {"source", sweep.source},
          {"file", sweep.file}, {"command", sweep.command}, {"copy", sweep.copy}};
}

Json sweptJson(const SweepRecord& sweep) {
  return {
      {"key", sweep.key}, {"axis", sweep.axis}, {"values", jsonList(sweep.values, [](double value) {
                                                   return jsonNumber(value, "sweep.values");
                                                 })}};
}

Json stepsJson(const SweepRecord& sweep) {
  Json steps = Json::array();
  for (std::size_t i = 0; i < sweep.steps.size(); ++i) {
    const double value = sweep.values.at(i);
    steps.push_back({{"value", jsonNumber(value, "steps.value")},
                     {"status", jsonStatus(sweep.steps[i].status())},
                     {"summary", sweepValueText(value) + "/summary.json"}});
  }
  return steps;
}

Json resultsJson(const SweepRecord& sweep) {
  Json results = Json::array();
  for (std::size_t i = 0; i < sweep.steps.size(); ++i) {
    for (const MethodMeans& method : studyMeans(sweep.steps[i]).methods) {
      Json row = {{"value", jsonNumber(sweep.values.at(i), "results.value")}};
      row.update(jsonMeans(method));
      const CostRecord* cost = costOf(sweep.steps[i], method.label);
      row["bytes"] = cost != nullptr ? Json(memoryBytes(*cost)) : Json(nullptr);
      row["frame_ms"] =
          jsonNumber(cost != nullptr ? cost->frameMs : std::nullopt, "results.frame_ms");
      results.push_back(std::move(row));
    }
  }
  return results;
}

}  // namespace

std::string sweepJson(const SweepRecord& sweep) {
  const EnvironmentRecord environment =
      sweep.steps.empty() ? EnvironmentRecord{} : sweep.steps.front().environment;
  const Json json = {
      {"schema", sweepSchema},          {"status", jsonStatus(sweep.status())},
      {"study", sweptStudyJson(sweep)}, {"environment", jsonEnvironment(environment)},
      {"sweep", sweptJson(sweep)},      {"steps", stepsJson(sweep)},
      {"results", resultsJson(sweep)},  {"claims", jsonList(sweep.claims, jsonClaim)}};
  return jsonText(json);
}

}  // namespace gnomon
