#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

#include "study/spec/sections/method_section.h"

namespace gnomon::study {

/// One cause of a ladder, and what corrects it.
struct CauseSpec {
  std::string name = {};    ///< "azimuth count"
  std::string change = {};  ///< what is put in its place, "256"; may be empty
};

/// `[[ladder.rung]]`
inline StudyKeys keysOf(CauseSpec& cause) {
  return {
      studyKey("cause", &cause.name, "of the error", {}, required, Enters::nothing),
      studyKey("change", &cause.change, "what is put in its place", {}, "none", Enters::nothing),
      studyKey("set", OwnCode{"a table"},
               "keys of `[[method]]` that correct it, all but `label`; no key in two rungs", {},
               required)};
}

/// A method from its published form to the best that this study can make of it, corrected one cause
/// at a time. Both orders begin at the method and end with all causes corrected: `forward` from the
/// first to the last, `backward` from the last to the first. Each has one state more than there are
/// causes.
struct LadderSpec {
  std::string method = {};  ///< label of the study's method
  std::vector<CauseSpec> causes;
  std::vector<MethodSpec> forward;
  std::vector<MethodSpec> backward;
  toml::table written = {};  ///< its table in the study's file
};

/// @param labels  of the study's methods
inline StudyKeys keysOf(LadderSpec& ladder, const std::vector<std::string>& labels) {
  StudyKeys keys = {
      studyKey("method", &ladder.method, "label of the `[[method]]` that it begins at", {},
               required, Enters::nothing, labels),
      studyKey("rung", OwnCode{"a list of tables"}, "the causes, in their order", {}, required)};
  MethodSpec method;
  for (StudyKey& key : keysOf(method)) {
    if (key.name == "label" || key.name == "masks") continue;
    key.place = OwnCode{typeText(key)};
    key.otherwise = "the method's";
    keys.push_back(std::move(key));
  }
  return keys;
}

}  // namespace gnomon::study
