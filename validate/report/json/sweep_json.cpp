#include "report/json/sweep_json.h"

#include <algorithm>

#include "report/json/json_values.h"
#include "report/tables/cost_table.h"
#include "report/text/gate_text.h"
#include "study/judge/study_ranking.h"

namespace gnomon::report {
namespace {

Json sweptStudyJson(const study::SweepRecord& sweep) {
  return {{"name", sweep.name}, {"title", sweep.title},     {"source", sweep.source},
          {"file", sweep.file}, {"command", sweep.command}, {"copy", sweep.copy}};
}

Json keyJson(const study::SweptKey& key) {
  return {{"key", key.key}, {"axis", key.axis}, {"dimension", key.dimension}};
}

Json sweptValueJson(const study::SweptValue& value) {
  return value.number ? jsonNumber(*value.number, "steps.values") : Json(value.text);
}

Json stepsJson(const study::SweepRecord& sweep) {
  Json steps = Json::array();
  for (std::size_t i = 0; i < sweep.steps.size(); ++i) {
    const study::SweepCase& which = sweep.cases.at(i);
    steps.push_back(
        {{"case", i + 1},
         {"name", which.name},
         {"values", jsonList(which.values, sweptValueJson)},
         {"status", jsonStatus(sweep.steps[i].status())},
         {"summary", sweep.hasStepReports ? Json(which.name + "/summary.json") : Json(nullptr)}});
  }
  return steps;
}

Json resultsJson(const study::SweepRecord& sweep) {
  Json results = Json::array();
  for (std::size_t i = 0; i < sweep.steps.size(); ++i) {
    for (const study::MethodMeans& method : study::studyMeans(sweep.steps[i]).methods) {
      Json row = {{"case", i + 1}};
      row.update(jsonMeans(method));
      const auto end = [&](double compare::Interval::*which) {
        return method.interval ? jsonNumber((*method.interval).*which, "results.interval")
                               : Json(nullptr);
      };
      row["low"] = end(&compare::Interval::low);
      row["high"] = end(&compare::Interval::high);
      const study::CostRecord* cost = costOf(sweep.steps[i], method.label);
      row["bytes"] = cost != nullptr ? Json(memoryBytes(*cost)) : Json(nullptr);
      row["frame_ms"] =
          jsonNumber(cost != nullptr ? cost->frameMs : std::nullopt, "results.frame_ms");
      results.push_back(std::move(row));
    }
  }
  return results;
}

/// Thresholds and references that do not hold.
Json faultsJson(const study::SweepRecord& sweep) {
  Json faults = Json::array();
  for (std::size_t i = 0; i < sweep.steps.size(); ++i) {
    for (const study::Judgement& judgement : sweep.steps[i].judgements) {
      if (!judgement.isFault()) continue;
      faults.push_back({{"case", i + 1},
                        {"origin", gateOriginName(judgement.gate)},
                        {"text", gateFaultText(judgement)}});
    }
  }
  return faults;
}

/// Each once, as a check tells them.
Json problemsJson(const study::SweepRecord& sweep) {
  Json problems = Json::array();
  for (const study::StudyRecord& step : sweep.steps) {
    for (const study::ProblemRecord& problem : step.problems) {
      Json json = jsonProblem(problem);
      if (std::find(problems.begin(), problems.end(), json) == problems.end()) {
        problems.push_back(std::move(json));
      }
    }
  }
  return problems;
}

}  // namespace

std::string sweepJson(const study::SweepRecord& sweep) {
  const study::EnvironmentRecord environment =
      sweep.steps.empty() ? study::EnvironmentRecord{} : sweep.steps.front().environment;
  const Json json = {{"schema", sweepSchema},
                     {"status", jsonStatus(sweep.status())},
                     {"study", sweptStudyJson(sweep)},
                     {"environment", jsonEnvironment(environment)},
                     {"keys", jsonList(sweep.keys, keyJson)},
                     {"steps", stepsJson(sweep)},
                     {"results", resultsJson(sweep)},
                     {"claims", jsonList(sweep.claims, jsonClaim)},
                     {"faults", faultsJson(sweep)},
                     {"problems", problemsJson(sweep)},
                     {"notices", sweep.notices()}};
  return jsonText(json);
}

}  // namespace gnomon::report
