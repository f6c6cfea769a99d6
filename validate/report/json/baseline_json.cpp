#include "report/json/baseline_json.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "common/lists.h"
#include "common/text/one_line.h"
#include "report/json/json_values.h"

namespace gnomon {
namespace fs = std::filesystem;
namespace {

std::string compact(const Json& json) {
  return plainJson(json, -1);
}

Json environmentJson(const EnvironmentRecord& environment) {
  Json json = jsonEnvironment(environment);
  for (const char* key : {"threads", "cpu", "frame_clock"}) json.erase(key);
  return json;
}

Json reasonJson(const BaselineReason& reason) {
  return {
      {"reason", reason.text}, {"gnomon_version", reason.gnomonVersion}, {"commit", reason.commit}};
}

Json valueJson(const Gate& gate) {
  const Reference& reference = referenceOf(gate);
  return {{"study", gate.step},
          {"method", gate.method},
          {"view", gate.view},
          {"light", gate.light},
          {"answer", answerName(gate.answer)},
          {"metric", gate.metric},
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

/// A JSON value with its place, so that errors can name it.
class Reader {
 public:
  Reader(const Json& json, std::string file, std::string path)
      : json_(&json), file_(std::move(file)), path_(std::move(path)) {}

  [[noreturn]] void fail(const std::string& key, const std::string& what) const {
    throw InputError(fmt::format("{}: {}{}: {}", file_, path_, key, oneLine(what)));
  }

  [[nodiscard]] const Json& at(const char* key, const char* expected,
                               bool (Json::*isRight)() const noexcept) const {
    if (!json_->is_object() || !json_->contains(key)) {
      fail(key, fmt::format("missing, {} expected", expected));
    }
    const Json& value = json_->at(key);
    if (!(value.*isRight)()) {
      fail(key, fmt::format("{} found, {} expected", value.type_name(), expected));
    }
    return value;
  }

  [[nodiscard]] std::string text(const char* key) const {
    return at(key, "a string", &Json::is_string).get<std::string>();
  }
  [[nodiscard]] double number(const char* key) const {
    return at(key, "a number", &Json::is_number).get<double>();
  }
  [[nodiscard]] Reader object(const char* key) const {
    return {at(key, "an object", &Json::is_object), file_, path_ + key + "."};
  }
  [[nodiscard]] std::vector<Reader> list(const char* key) const {
    std::vector<Reader> entries;
    for (const Json& entry : at(key, "a list", &Json::is_array)) {
      entries.emplace_back(entry, file_, fmt::format("{}{}.{}.", path_, key, entries.size()));
    }
    return entries;
  }

 private:
  const Json* json_;
  std::string file_;
  std::string path_;
};

Json parsed(const fs::path& path) {
  const std::string text = readFile(path);
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    const auto read = static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
    const auto line = 1 + std::count(text.begin(), text.begin() + read, '\n');
    throw InputError(fmt::format("{}:{}: no JSON: {}", path.string(), line, error.what()));
  } catch (const Json::exception& error) {
    // A number that no double holds.
    throw InputError(fmt::format("{}: no JSON: {}", path.string(), error.what()));
  }
}

EnvironmentRecord readEnvironment(const Reader& reader) {
  EnvironmentRecord environment;
  environment.gnomonVersion = reader.text("gnomon_version");
  environment.commit = reader.text("commit");
  environment.glRenderer = reader.text("gl_renderer");
  environment.glVersion = reader.text("gl_version");
  environment.embreeVersion = reader.text("embree_version");
  environment.openSubdivVersion = reader.text("opensubdiv_version");
  return environment;
}

/// @throws InputError for numbers that the metric cannot have, or a tolerance that is too large
void requireSense(const Reader& reader, const std::string& metric, const Reference& reference) {
  const auto [value, spread, tolerance] = reference;
  const bool isShare = !isLengthMetric(metric);
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
  const double most = toleranceOf(metric, spread) * (1 + 1e-6);
  if (!(tolerance <= most)) {
    reader.fail("tolerance",
                fmt::format("{} found, at most {:.6g} expected: twice the spread, or {:.6g}",
                            tolerance, most, toleranceOf(metric, 0)));
  }
}

Gate readGate(const Reader& reader) {
  Gate row;
  row.step = reader.text("study");
  row.method = reader.text("method");
  row.light = reader.text("light");
  row.view = reader.text("view");
  row.metric = reader.text("metric");
  const Reference reference{reader.number("value"), reader.number("spread"),
                            reader.number("tolerance")};
  const std::string answer = reader.text("answer");
  if (!answerOfName(answer)) {
    reader.fail("answer", fmt::format("\"{}\" found, drawn or test expected", answer));
  }
  row.answer = *answerOfName(answer);
  if (!contains(baselineMetrics(row.answer), row.metric)) {
    reader.fail("metric", fmt::format("\"{}\" found, a metric of baselines expected", row.metric));
  }
  requireSense(reader, row.metric, reference);
  Gate gate = referenceGate(std::move(row), reference);
  if (!canFail(gate)) {
    reader.fail("tolerance", fmt::format("{} found, but with it no value of {} could be too bad",
                                         reference.tolerance, gate.metric));
  }
  return gate;
}

}  // namespace

std::string baselineJson(const Baseline& baseline) {
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

Baseline readBaseline(const fs::path& path) {
  const Json json = parsed(path);
  const Reader root(json, path.string(), "");
  const std::string schema = root.text("schema");
  if (schema != baselineSchema) {
    root.fail("schema", fmt::format("\"{}\" found, \"{}\" expected", schema, baselineSchema));
  }
  Baseline baseline;
  baseline.study = root.text("study");
  const std::string form = root.text("form");
  if (form != "full" && form != "quick") {
    root.fail("form", fmt::format("\"{}\" found, full or quick expected", form));
  }
  baseline.quick = form == "quick";
  baseline.environment = readEnvironment(root.object("environment"));
  for (const Reader& entry : root.list("history")) {
    baseline.history.push_back(
        {entry.text("reason"), entry.text("gnomon_version"), entry.text("commit")});
  }
  const std::vector<Reader> values = root.list("values");
  for (const Reader& value : values) baseline.gates.push_back(readGate(value));
  std::set<decltype(valueKey(Gate()))> seen;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (seen.insert(valueKey(baseline.gates[i])).second) continue;
    values[i].fail("metric", "a second value of the same row and metric found, one expected");
  }
  return baseline;
}

}  // namespace gnomon
