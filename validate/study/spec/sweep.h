#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "study/spec/study_file.h"

namespace gnomon {

/// `[sweep]` of a study file: the study is run once for each value of one key.
struct SweepSpec {
  std::string key;             ///< any key of the file that an override may set
  std::vector<double> values;  ///< at least two, distinct
  std::string axis;            ///< the key itself, unless the file says better
};

inline StudyKeys keysOf(SweepSpec& sweep) {
  using enum Enters;
  return {studyKey("key", &sweep.key, "any that `--set` takes, as `relief.height`", {}, required,
                   nothing),
          studyKey("values", NumberOrList{&sweep.values},
                   "of the key, at least two: the study runs at each", {}, required, nothing),
          studyKey("axis", &sweep.axis, "label of the plots' axis", {}, "the key", nothing)};
}

/// What a study file asks for: one study, or one for each value of its sweep.
struct StudyPlan {
  std::string name;  ///< of the file's study
  std::string title, source;
  std::optional<SweepSpec> sweep;
  /// One, without a sweep. A step of a sweep is the file with `key=value` as its last override; it
  /// is named `NAME/VALUE`, the value's shortest text, so that its folder lies in the sweep's.
  std::vector<StudySpec> steps;
};

/// Whether a step of a plan is wanted, by its place among all of them; each is, where it is empty.
using StepFilter = std::function<bool(std::size_t step)>;

/// Reads and checks a study file with all its steps, or with those that are wanted.
/// @throws InputError as readStudy; for a sweep without a second value or with repeated ones, of a
///   key that the file cannot have, that names the study, or that `options` overrides as well; and
///   for a value that the key cannot take: all name file, line and key of `[sweep]`
StudyPlan readStudyPlan(const std::filesystem::path& file, const StudyOptions& options = {},
                        const StepFilter& wants = {});

}  // namespace gnomon
