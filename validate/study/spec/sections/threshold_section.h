#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

#include "study/record/gate.h"
#include "study/spec/sections/study_key.h"

namespace gnomon::study {

/// The names of the regions that results are reported for, in order, "all" first: those that gates
/// and claims may speak of.
/// @param partNames  of the surface
std::vector<std::string> judgedRegions(const std::vector<std::string>& partNames);

/// The names in a study that its gates and claims may speak of.
struct StudyNames {
  std::vector<std::string> methods = {}, lights = {}, views = {};
  std::vector<std::string> regions = judgedRegions({});
};

/// `[[threshold]]` without any key but its place in the file.
inline Gate newThreshold(int line = 0, const toml::table& written = {}) {
  Gate gate;
  gate.region = "all";
  gate.origin = Threshold{line, true, written};
  return gate;
}

/// The keys that gates and claims have in common.
template <typename Judged>
StudyKeys judgedKeys(Judged& judged, const StudyNames& names) {
  const std::vector<std::pair<Answer, std::string>> answers = {{Answer::drawn, "drawn"},
                                                               {Answer::test, "test"}};
  std::vector<std::pair<compare::MetricId, std::string>> metrics;
  for (const compare::MetricId id : compare::allMetrics()) metrics.emplace_back(id, id.name());
  return {studyKey("metric", chosenName(judged.metric, metrics), "that is judged", {}, {},
                   Enters::nothing),
          studyKey("region", &judged.region, "where samples count", {}, {}, Enters::nothing,
                   names.regions),
          studyKey("answer", chosenName(judged.answer, answers),
                   "what the method's picture shows, or its shadow test alone", {}, {},
                   Enters::nothing)};
}

inline StudyKeys keysOf(Gate& gate, const StudyNames& names) {
  using enum Enters;
  StudyKeys keys = {
      studyKey("method", &gate.method, "label of the only one that is judged", {}, "all", nothing,
               names.methods),
      studyKey("light", &gate.light, "name of the only one", {}, "all", nothing, names.lights),
      studyKey("view", &gate.view, "name of the only one", {}, "all", nothing, names.views),
      studyKey("min", OwnCode{"a number, or of a share a percentage as `\"5 %\"`"},
               "the least value; a limit that cannot fail is refused: [limits](ci.md#limits)", {},
               "none, `max` is there"),
      studyKey("max", OwnCode{"as `min`"}, "the largest value", {}, "none, `min` is there"),
      studyKey("quick", &std::get<Threshold>(gate.origin).quick,
               "`false` holds only the full form to it", {}, {}, nothing)};
  for (StudyKey& key : judgedKeys(gate, names)) keys.push_back(std::move(key));
  return keys;
}

/// `[[claim]]`, of one of two forms: that one method's metric is smaller than another's in every
/// light and view; or that one method's metric lies between bounds in every light and view.
struct ClaimSpec {
  std::string text, source;
  std::string less, than;  ///< method labels; empty in the second form
  compare::MetricId metric = compare::metrics::errorRate;
  std::string region = "all";
  std::string method = {};  ///< label; empty in the first form
  std::optional<double> above = std::nullopt, below = std::nullopt;
  Answer answer = Answer::drawn;
  toml::table written = {};  ///< its table in the study's file
};

/// The keys of both forms.
inline StudyKeys keysOf(ClaimSpec& claim, const StudyNames& names) {
  StudyKeys keys = {
      studyKey("text", &claim.text, "the claim in words", {}, required, Enters::nothing),
      studyKey("source", &claim.source, "who makes it", {}, required, Enters::nothing)};
  for (StudyKey& key : judgedKeys(claim, names)) keys.push_back(std::move(key));
  return keys;
}

inline StudyKeys comparisonKeys(ClaimSpec& claim, const StudyNames& names) {
  using enum Enters;
  return {
      studyKey("less", &claim.less, "label of the method whose metric is smaller", {}, required,
               nothing, names.methods),
      studyKey("than", &claim.than, "label of the other", {}, required, nothing, names.methods)};
}

inline StudyKeys boundKeys(ClaimSpec& claim, const StudyNames& names) {
  using enum Enters;
  return {studyKey("method", &claim.method, "label of the method", {}, required, nothing,
                   names.methods),
          studyKey("above", OptionalNumber{&claim.above}, "its metric is larger", {},
                   "none, `below` is there", nothing),
          studyKey("below", OptionalNumber{&claim.below}, "its metric is smaller", {},
                   "none, `above` is there", nothing)};
}

}  // namespace gnomon::study
