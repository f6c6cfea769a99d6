#include "report/json/json_values.h"

#include <fmt/core.h>

#include <algorithm>
#include <set>
#include <sstream>
#include <utility>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "common/lists.h"
#include "common/text.h"
#include "report/text/number_text.h"
#include "report/text/verdict_text.h"
#include "report/view_images.h"

namespace gnomon::report {

namespace {

Json flipJson(const study::UncertaintyRecord& flip) {
  Json boundaries = Json::object();
  addMetrics(boundaries, flip.boundaries);
  Json json = {{"view", flip.view},
               {"light", flip.light},
               {"flip_rate", jsonNumber(flip.flipRate, "truth.flips.flip_rate")},
               {"length_error", jsonNumber(flip.lengthError, "truth.flips.length_error")},
               {"boundaries", std::move(boundaries)}};
  if (flip.brightening) {
    json["brightening"] = jsonNumber(flip.brightening, "truth.flips.brightening");
  }
  if (flip.percentile99) {
    Json shares = Json::object();
    addMetrics(shares, flip.shares);
    json["percentile_99"] = jsonNumber(flip.percentile99, "truth.flips.percentile_99");
    json["percentile_99_9"] = jsonNumber(flip.percentile999, "truth.flips.percentile_99_9");
    json["shares"] = std::move(shares);
  }
  return json;
}

/// A study's settings hold no dates, which JSON does not know.
Json tomlJson(const toml::node& node) {
  if (const auto* table = node.as_table()) {
    Json json = Json::object();
    for (const auto& [key, value] : *table) json[std::string(key.str())] = tomlJson(value);
    return json;
  }
  if (const auto* array = node.as_array()) return jsonList(*array, tomlJson);
  if (const auto text = node.value_exact<std::string>()) return *text;
  if (const auto flag = node.value_exact<bool>()) return *flag;
  if (const auto whole = node.value_exact<std::int64_t>()) return *whole;
  const auto number = node.value_exact<double>();
  if (!number) throw InternalError("study.settings: a value that is neither text nor number");
  return jsonNumber(*number, "study.settings");
}

Json inputJson(const study::InputRecord& input) {
  return {{"kind", inputKindName(input.kind)}, {"file", input.file}, {"sha256", input.sha256}};
}

Json spreadJson(const study::ClaimSpread& spread) {
  const auto quartile = [&](double study::Quartiles::*which) {
    return jsonNumber(spread.quartiles ? std::optional((*spread.quartiles).*which) : std::nullopt,
                      "claims.spread");
  };
  return {
      {"cases", spread.cases},
      {"held", spread.held},
      {"failed", spread.failed},
      {"equal", spread.equal},
      {"not_distinguishable", spread.notDistinguishable()},
      {"no_interval", spread.withoutInterval},
      {"intervals", spread.hasIntervals},
      {"together", spread.together ? Json(study::verdictName(*spread.together)) : Json(nullptr)},
      {"quantity", spread.quantity},
      {"least", quartile(&study::Quartiles::least)},
      {"quartile_1", quartile(&study::Quartiles::first)},
      {"median", quartile(&study::Quartiles::median)},
      {"quartile_3", quartile(&study::Quartiles::third)},
      {"most", quartile(&study::Quartiles::most)}};
}

}  // namespace

Json jsonNumber(double value, std::string_view key) {
  return requireFinite(value, key);
}

Json jsonNumber(std::optional<double> value, std::string_view key) {
  return value ? jsonNumber(*value, key) : Json(nullptr);
}

Json jsonReason(const std::string& reason) {
  return reason.empty() ? Json(nullptr) : Json(reason);
}

void addMetrics(Json& json, const std::vector<compare::Metric>& metrics) {
  Json undefined = Json::object();
  for (const compare::Metric& metric : metrics) {
    const std::string name(metric.name());
    json[name] = jsonNumber(metric.value, name);
    if (!metric.value) undefined[name] = metric.reason;
  }
  json["undefined"] = std::move(undefined);
}

Json jsonEnvironment(const study::EnvironmentRecord& environment) {
  return {{"gnomon_version", environment.gnomonVersion},
          {"commit", environment.commit},
          {"cpu", environment.cpu},
          {"threads", environment.threads > 0 ? Json(environment.threads) : Json(nullptr)},
          {"gl_renderer", environment.glRenderer},
          {"frame_clock", environment.frameClock},
          {"gl_version", environment.glVersion},
          {"embree_version", environment.embreeVersion},
          {"opensubdiv_version", environment.openSubdivVersion}};
}

Json jsonRegionColours() {
  Json colours = Json::object();
  for (const truth::Region region : truth::reportedRegions) {
    colours[std::string(truth::regionName(region))] = regionColour(region);
  }
  colours[std::string(truth::regionName(truth::Region::none))] = regionColour(truth::Region::none);
  return colours;
}

Json jsonStudy(const study::StudyRecord& record) {
  return {{"name", record.name},
          {"title", record.title},
          {"source", record.source},
          {"file", record.file},
          {"command", record.command},
          {"copy", record.reproduction.file},
          {"settings", tomlJson(record.reproduction.settings)},
          {"inputs", jsonList(record.reproduction.inputs, inputJson)}};
}

Json jsonRadius(const study::RadiusRecord& radius) {
  return {{"texels", jsonNumber(radius.texels, "search_radius.texels")}, {"reason", radius.reason}};
}

Json jsonTruth(const study::TruthRecord& truth) {
  return {{"micro_triangles", truth.microTriangles},
          {"step_texels", jsonNumber(truth.stepTexels, "truth.step_texels")},
          {"uncertainty", jsonNumber(truth.uncertainty, "truth.uncertainty")},
          {"bvh_bytes", truth.bvhBytes ? Json(*truth.bvhBytes) : Json(nullptr)},
          {"mesh_bytes", truth.meshBytes},
          {"flips", jsonList(truth.flips, flipJson)}};
}

Json jsonClaim(const study::ClaimRecord& claim) {
  return {{"text", claim.text},
          {"source", claim.source},
          {"verdict", study::verdictName(claim.verdict)},
          {"detail", claim.detail},
          {"methods", claim.methods},
          {"spread", claim.spread ? spreadJson(*claim.spread) : Json(nullptr)}};
}

Json jsonMeans(const study::MethodMeans& means) {
  return {{"method", means.label},
          {"error_rate", jsonNumber(means.errorRate, "results.error_rate")},
          {"false_shadow", jsonNumber(means.falseShadow, "results.false_shadow")},
          {"false_light", jsonNumber(means.falseLight, "results.false_light")},
          {"uncertainty", jsonNumber(means.uncertainty, "results.uncertainty")},
          {"cases", means.cases()},
          {"all_cases", means.caseErrors.size()}};
}

Json jsonStatus(study::RunStatus status) {
  return runStatusName(status);
}

Json jsonJudgement(const study::Judgement& judgement) {
  const study::Gate& gate = judgement.gate;
  const bool passed = judgement.verdict == study::GateVerdict::passed;
  Json json = Json::object();
  const auto addRow = [&] {
    json["method"] = gate.method;
    json["light"] = gate.light;
    json["view"] = gate.view;
    json["answer"] = study::answerName(gate.answer);
  };
  const auto addValue = [&](const std::string& list) {
    json["value"] = jsonNumber(judgement.value, list + ".value");
    json["minimum"] = jsonNumber(gate.minimum, list + ".minimum");
    json["maximum"] = jsonNumber(gate.maximum, list + ".maximum");
  };
  std::visit(Overloaded{[&](const study::Threshold&) {
                          addRow();
                          json["region"] = gate.region;
                          json["metric"] = gate.metric.name();
                          addValue("thresholds");
                          json["passed"] = passed;
                          json["reason"] = jsonReason(judgement.reason);
                        },
                        [&](const study::Reference& reference) {
                          addRow();
                          json["metric"] = gate.metric.name();
                          json["committed"] =
                              jsonNumber(reference.committed, "references.committed");
                          addValue("references");
                          json["verdict"] = gateVerdictName(judgement.verdict);
                          json["reason"] = jsonReason(judgement.reason);
                        },
                        [&](const study::CompareOption&) {
                          json["metric"] = gate.metric.name();
                          addValue("gates");
                          json["passed"] = passed;
                        }},
             gate.origin);
  return json;
}

Json jsonProblem(const study::ProblemRecord& problem) {
  return {{"part", problem.part}, {"message", problem.message}};
}

std::string plainJson(const Json& json, int indent) {
  const std::string dumped = json.dump(indent, ' ', false, Json::error_handler_t::replace);
  std::string text;
  text.reserve(dumped.size());
  for (std::string_view rest = dumped; !rest.empty();) {
    const Utf8Character character = firstCharacter(rest);
    // JSON stands on terminals and in logs too. In a string an escape is the same character.
    const bool moves =
        character.code != '\n' && (isControl(character.code) || reversesText(character.code));
    if (moves) {
      text += fmt::format("\\u{:04x}", character.code);
    } else if (rest.starts_with('[') && text.ends_with("##")) {
      text += "\\u005b";
    } else {
      text += rest.substr(0, character.bytes);
    }
    rest.remove_prefix(character.bytes);
  }
  return text;
}

std::string jsonText(const Json& json) {
  return plainJson(json, 2) + "\n";
}

JsonReader::JsonReader(const Json& json, std::string file, std::string path)
    : json_(&json), file_(std::move(file)), path_(std::move(path)) {}

void JsonReader::fail(const std::string& key, const std::string& what) const {
  throw InputError(fmt::format("{}: {}{}: {}", file_, path_, key, oneLine(what)));
}

const Json& JsonReader::at(const char* key, const char* expected,
                           bool (Json::*isRight)() const noexcept) const {
  if (!has(key)) fail(key, fmt::format("missing, {} expected", expected));
  const Json& value = json_->at(key);
  if (!(value.*isRight)()) {
    fail(key, fmt::format("{} found, {} expected", value.type_name(), expected));
  }
  return value;
}

bool JsonReader::has(const char* key) const {
  return json_->is_object() && json_->contains(key);
}

bool JsonReader::isNull(const char* key) const {
  return has(key) && json_->at(key).is_null();
}

bool JsonReader::flag(const char* key) const {
  return at(key, "true or false", &Json::is_boolean).get<bool>();
}

std::string JsonReader::text(const char* key) const {
  return at(key, "a string", &Json::is_string).get<std::string>();
}

double JsonReader::number(const char* key) const {
  return at(key, "a number", &Json::is_number).get<double>();
}

std::optional<double> JsonReader::numberOrNull(const char* key) const {
  if (isNull(key)) return std::nullopt;
  return number(key);
}

JsonReader JsonReader::object(const char* key) const {
  return {at(key, "an object", &Json::is_object), file_, path_ + key + "."};
}

std::vector<std::string> JsonReader::texts(const char* key) const {
  std::vector<std::string> entries;
  for (const Json& entry : at(key, "a list", &Json::is_array)) {
    if (!entry.is_string()) fail(key, "a list of strings expected");
    entries.push_back(entry.get<std::string>());
  }
  return entries;
}

std::vector<JsonReader> JsonReader::list(const char* key) const {
  std::vector<JsonReader> entries;
  for (const Json& entry : at(key, "a list", &Json::is_array)) {
    entries.emplace_back(entry, file_, fmt::format("{}{}.{}.", path_, key, entries.size()));
  }
  return entries;
}

Json readJson(const std::filesystem::path& path) {
  const std::string text = readFile(path);
  std::istringstream stream(text);          // it tells how far the parser has come
  std::vector<std::set<std::string>> keys;  // of the objects that are open
  const auto refuseSecond = [&](int, Json::parse_event_t event, const Json& parsed) {
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key && !keys.back().insert(parsed).second) {
      const auto line = 1 + std::count(text.begin(), text.begin() + stream.tellg(), '\n');
      throw InputError(fmt::format("{}:{}: {}: a second time in one object, one expected",
                                   path.string(), line, oneLine(parsed.dump())));
    }
    return true;
  };
  try {
    return Json::parse(stream, refuseSecond);
  } catch (const Json::parse_error& error) {
    const auto read = static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
    const auto line = 1 + std::count(text.begin(), text.begin() + read, '\n');
    throw InputError(fmt::format("{}:{}: no JSON: {}", path.string(), line, error.what()));
  } catch (const Json::exception& error) {
    // A number that no double holds.
    throw InputError(fmt::format("{}: no JSON: {}", path.string(), error.what()));
  }
}

}  // namespace gnomon::report
