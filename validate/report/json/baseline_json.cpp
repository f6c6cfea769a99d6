#include "report/json/baseline_json.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "common/lists.h"
#include "report/json/json_values.h"

namespace gnomon::report {
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
