#include "report/json/ranking_json.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>

#include "common/files/input_file.h"
#include "report/json/json_values.h"
#include "report/tables/cost_table.h"
#include "report/text/gate_text.h"
#include "report/text/number_text.h"
#include "study/judge/ranking.h"

namespace gnomon::report {

namespace {

Json studyJson(const study::StudyMeans& study) {
  return {{"name", study.name},
          {"title", study.title},
          {"status", jsonStatus(study.status)},
          {"report", study.name + "/report.html"}};
}

Json rankedMethodJson(const study::RankedOverStudies& method) {
  return {{"rank", method.rank ? Json(*method.rank) : Json(nullptr)},
          {"label", method.label},
          {"names", method.names},
          {"studies", method.studies},
          {"cases", method.cases},
          {"all_cases", method.allCases},
          {"mean_error_rate", jsonNumber(method.meanError, "methods.mean_error_rate")},
          {"worst_error_rate", jsonNumber(method.worstError, "methods.worst_error_rate")},
          {"worst_study", method.worstError ? Json(method.worstStudy) : Json(nullptr)},
          {"uncertainty", jsonNumber(method.uncertainty, "methods.uncertainty")},
          {"leader_error_rate", jsonNumber(method.leaderError, "methods.leader_error_rate")},
          {"to_best",
           method.toBest ? Json(differenceVerdictName(method.toBest->verdict)) : Json(nullptr)},
          {"reason", jsonReason(method.toBest ? method.toBest->reason : "")}};
}

Json resultsJson(std::span<const study::StudyMeans> studies) {
  Json results = Json::array();
  for (const study::StudyMeans& study : studies) {
    for (const study::MethodMeans& method : study.methods) {
      Json row = {{"study", study.name}};
      row.update(jsonMeans(method));
      results.push_back(std::move(row));
    }
  }
  return results;
}

Json claimsJson(std::span<const study::StudyMeans> studies) {
  Json claims = Json::array();
  for (const study::StudyMeans& study : studies) {
    for (const study::ClaimRecord& claim : study.claims) {
      Json json = {{"study", study.name}};
      json.update(jsonClaim(claim));
      claims.push_back(std::move(json));
    }
  }
  return claims;
}

}  // namespace

std::string rankingJson(std::span<const study::StudyMeans> studies, std::string_view command) {
  const Json json = {{"schema", rankingSchema},
                     {"status", jsonStatus(study::statusOf(studies))},
                     {"command", command},
                     {"studies", jsonList(studies, studyJson)},
                     {"methods", jsonList(study::rankOverStudies(studies), rankedMethodJson)},
                     {"results", resultsJson(studies)},
                     {"claims", claimsJson(studies)}};
  return jsonText(json);
}

namespace {

using Json = nlohmann::ordered_json;

Json jsonOf(const toml::table& facts) {
  std::ostringstream text;
  text << toml::json_formatter{facts};
  return Json::parse(text.str());
}

}  // namespace

std::string suiteManifest(const study::DrawnSuite& suite) {
  Json manifest = {{"schema", 1},
                   {"suite", suite.suite},
                   {"split", study::splitName(suite.split)},
                   {"seed", suite.seed},
                   {"sha256", suite.sha256}};
  manifest["studies"] = Json::array();
  for (const study::SuiteStudy& study : suite.studies) {
    manifest["studies"].push_back({{"file", study.file},
                                   {"sha256", sha256(study.text)},
                                   {"scene_sha256", sha256(study.scene)},
                                   {"drawn", jsonOf(study.facts)}});
  }
  manifest["files"] = Json::array();
  for (const study::SuiteCopy& copy : suite.copies) {
    manifest["files"].push_back({{"file", copy.file}, {"sha256", sha256(copy.bytes)}});
  }
  return manifest.dump(1) + "\n";
}

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
