#include "report/json/results_json.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "common/files/input_file.h"
#include "common/lists.h"
#include "report/json/json_values.h"
#include "report/tables/cost_table.h"
#include "report/text/number_text.h"
#include "report/text/verdict_text.h"
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

namespace fs = std::filesystem;
namespace {

std::string compact(const Json& json) {
  return plainJson(json, -1);
}

Json environmentJson(const study::EnvironmentRecord& environment) {
  Json json = jsonEnvironment(environment);
  for (const char* key : {"threads", "cpu", "frame_clock"}) json.erase(key);
  return json;
}

Json reasonJson(const study::BaselineReason& reason) {
  Json json = {
      {"reason", reason.text}, {"gnomon_version", reason.gnomonVersion}, {"commit", reason.commit}};
  if (!reason.repository.empty()) json["repository_commit"] = reason.repository;
  return json;
}

Json valueJson(const study::Gate& gate) {
  const study::Reference& reference = study::referenceOf(gate);
  return {{"study", gate.step},
          {"method", gate.method},
          {"view", gate.view},
          {"light", gate.light},
          {"answer", study::answerName(gate.answer)},
          {"metric", gate.metric.name()},
          {"value", jsonNumber(reference.committed, "values.value")},
          {"spread", jsonNumber(reference.spread, "values.spread")},
          {"tolerance", jsonNumber(reference.tolerance, "values.tolerance")}};
}

template <typename Entries, typename ToJson>
std::string lines(const Entries& entries, const ToJson& toJson) {
  std::string text;
  for (const auto& entry : entries) {
    text += fmt::format("{}    {}", text.empty() ? "\n" : ",\n", compact(toJson(entry)));
  }
  return text.empty() ? "[]" : "[" + text + "\n  ]";
}

study::EnvironmentRecord readEnvironment(const JsonReader& reader) {
  study::EnvironmentRecord environment;
  environment.gnomonVersion = reader.text("gnomon_version");
  environment.commit = reader.text("commit");
  environment.glRenderer = reader.text("gl_renderer");
  environment.glVersion = reader.text("gl_version");
  environment.embreeVersion = reader.text("embree_version");
  environment.openSubdivVersion = reader.text("opensubdiv_version");
  return environment;
}

/// @throws InputError for numbers that the metric cannot have, or a tolerance that is too large
void requireSense(const JsonReader& reader, compare::MetricId metric,
                  const study::Reference& reference) {
  const auto [value, spread, tolerance] = reference;
  const bool isShare = metric.unit() == compare::MetricUnit::share;
  if (!(value >= 0) || (isShare && value > 1)) {
    reader.fail("value",
                fmt::format("{} found, {} expected", value, isShare ? "0 to 1" : "at least 0"));
  }
  if (!(spread >= 0)) {
    reader.fail("spread", fmt::format("{} found, at least 0 expected", spread));
  }
  if (!(tolerance > spread)) {
    reader.fail("tolerance",
                fmt::format("{} found, more than the spread {} expected", tolerance, spread));
  }
  // One more digit than a file that was rounded by hand.
  const double most = study::toleranceOf(metric, spread) * (1 + 1e-6);
  if (!(tolerance <= most)) {
    reader.fail("tolerance",
                fmt::format("{} found, at most {:.6g} expected: twice the spread, or {:.6g}",
                            tolerance, most, study::toleranceOf(metric, 0)));
  }
}

study::Gate readGate(const JsonReader& reader) {
  study::Gate row;
  row.step = reader.text("study");
  row.method = reader.text("method");
  row.light = reader.text("light");
  row.view = reader.text("view");
  const study::Reference reference{reader.number("value"), reader.number("spread"),
                                   reader.number("tolerance")};
  const std::string answer = reader.text("answer");
  if (!study::answerOfName(answer)) {
    reader.fail("answer", fmt::format("\"{}\" found, drawn or test expected", answer));
  }
  row.answer = *study::answerOfName(answer);
  const std::string name = reader.text("metric");
  const auto metric = compare::MetricId::find(name);
  if (!metric || !contains(study::baselineMetrics(row.answer), *metric)) {
    reader.fail("metric", fmt::format("\"{}\" found, a metric of baselines expected", name));
  }
  row.metric = *metric;
  requireSense(reader, row.metric, reference);
  study::Gate gate = study::referenceGate(std::move(row), reference);
  if (!study::canFail(gate)) {
    reader.fail("tolerance", fmt::format("{} found, but with it no value of {} could be too bad",
                                         reference.tolerance, gate.metric.name()));
  }
  return gate;
}

}  // namespace

std::string baselineJson(const study::Baseline& baseline) {
  const Json head = {{"schema", baselineSchema},
                     {"study", baseline.study},
                     {"form", baseline.quick ? "quick" : "full"},
                     {"environment", environmentJson(baseline.environment)}};
  std::string text = "{";
  for (const auto& [key, value] : head.items()) {
    text += fmt::format("\n  {}: {},", compact(key), compact(value));
  }
  text += fmt::format("\n  \"history\": {},", lines(baseline.history, reasonJson));
  return text + fmt::format("\n  \"values\": {}\n}}\n", lines(baseline.gates, valueJson));
}

study::Baseline readBaseline(const fs::path& path) {
  const Json json = readJson(path);
  const JsonReader root(json, path.string(), "");
  const std::string schema = root.text("schema");
  if (schema != baselineSchema) {
    root.fail("schema", fmt::format("\"{}\" found, \"{}\" expected", schema, baselineSchema));
  }
  study::Baseline baseline;
  baseline.study = root.text("study");
  const std::string form = root.text("form");
  if (form != "full" && form != "quick") {
    root.fail("form", fmt::format("\"{}\" found, full or quick expected", form));
  }
  baseline.quick = form == "quick";
  baseline.environment = readEnvironment(root.object("environment"));
  for (const JsonReader& entry : root.list("history")) {
    baseline.history.push_back(
        {entry.text("reason"), entry.text("gnomon_version"), entry.text("commit"),
         entry.has("repository_commit") ? entry.text("repository_commit") : ""});
  }
  const std::vector<JsonReader> values = root.list("values");
  for (const JsonReader& value : values) baseline.gates.push_back(readGate(value));
  std::set<decltype(study::valueKey(study::Gate()))> seen;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (seen.insert(study::valueKey(baseline.gates[i])).second) continue;
    values[i].fail("metric", "a second value of the same row and metric found, one expected");
  }
  return baseline;
}

}  // namespace gnomon::report
