#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compare/counts.h"
#include "study/judge/ranking.h"
#include "study/record/record.h"

namespace gnomon::report {

/// Parts that the JSON files of a run share. Keys stay in the order in which they were set.
using Json = nlohmann::ordered_json;

/// A number.
/// @throws InternalError naming the key for one that is not finite: the library would write it as
///   null, without a word
Json jsonNumber(double value, std::string_view key);
/// A number, or null.
Json jsonNumber(std::optional<double> value, std::string_view key);

/// A reason, or null where there is none to give.
Json jsonReason(const std::string& reason);

/// Adds each value by its name, and under `undefined` why there is none.
void addMetrics(Json& json, const std::vector<compare::Metric>& metrics);

template <typename Records, typename Convert>
Json jsonList(const Records& records, const Convert& convert) {
  Json array = Json::array();
  for (const auto& record : records) array.push_back(convert(record));
  return array;
}

/// How far occluders are searched: texels, and reason.
Json jsonRadius(const study::RadiusRecord& radius);
/// The colours of a picture of regions, by the regions' names.
Json jsonRegionColours();

Json jsonEnvironment(const study::EnvironmentRecord& environment);
/// name, title, source, file, command, copy, settings, inputs.
Json jsonStudy(const study::StudyRecord& record);
/// micro_triangles, step_texels, uncertainty, bvh_bytes, mesh_bytes, and `flips` by view and light.
Json jsonTruth(const study::TruthRecord& truth);
/// text, source, verdict, detail; `spread` over the study's cases, or null: cases, held, failed,
/// not_distinguishable (numbers of cases), intervals (false: judged by the truth's uncertainty
/// alone), together (the verdict on the mean of all cases), quantity ("ratio", `less` over `than`;
/// or "value"), and its least, quartile_1, median, quartile_3, most (null where no case has it).
Json jsonClaim(const study::ClaimRecord& claim);
/// method, error_rate, false_shadow, false_light, uncertainty, cases, all_cases.
Json jsonMeans(const study::MethodMeans& means);
/// The status of a run by its name.
Json jsonStatus(study::RunStatus status);
/// The result of a gate, with the keys of its origin. Of a threshold: method, light, view, answer,
/// region, metric, value, minimum, maximum, passed, reason. Of a reference: method, light, view,
/// answer, metric, committed, value, minimum, maximum, verdict, reason. Of an option of `compare`:
/// metric, value, minimum, maximum, passed.
Json jsonJudgement(const study::Judgement& judgement);
/// part, message.
Json jsonProblem(const study::ProblemRecord& problem);

/// JSON as UTF-8 (bytes that are not become U+FFFD). Characters that would move a terminal's cursor
/// or turn the direction of text, and the [ of `##[`, which GitHub's runner would take for a
/// command, are written as \uXXXX: the same string.
/// @param indent  spaces; -1 for all on one line
std::string plainJson(const Json& json, int indent);

/// The file's text, as plainJson: two spaces of indent, a last LF.
std::string jsonText(const Json& json);

/// A JSON object with its place in a file, so that errors can name it: "FILE: results.3.tp: null
/// found, a number expected". It does not own the JSON.
class JsonReader {
 public:
  /// @param path  of the object in the file, with a dot at its end; empty for the file's own
  JsonReader(const Json& json, std::string file, std::string path);

  /// @throws InputError that names file and key
  [[noreturn]] void fail(const std::string& key, const std::string& what) const;

  /// The value of a key.
  /// @throws InputError where it is missing or of another type; also below
  [[nodiscard]] std::string text(const char* key) const;
  [[nodiscard]] double number(const char* key) const;
  /// None for null.
  [[nodiscard]] std::optional<double> numberOrNull(const char* key) const;
  [[nodiscard]] JsonReader object(const char* key) const;
  [[nodiscard]] std::vector<JsonReader> list(const char* key) const;
  [[nodiscard]] std::vector<std::string> texts(const char* key) const;
  [[nodiscard]] bool flag(const char* key) const;
  [[nodiscard]] bool has(const char* key) const;
  /// Whether the key is there with the value null.
  [[nodiscard]] bool isNull(const char* key) const;

 private:
  [[nodiscard]] const Json& at(const char* key, const char* expected,
                               bool (Json::*isRight)() const noexcept) const;

  const Json* json_;
  std::string file_;
  std::string path_;
};

/// @throws InputError for a file that cannot be read, is no JSON, or has a key twice in one object
///   (the JSON standard leaves open which of them counts), naming the line
Json readJson(const std::filesystem::path& path);

}  // namespace gnomon::report
