#pragma once

#include "study/spec/sections/threshold_section.h"

namespace gnomon::study {

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
