#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "study/record/sweep_record.h"
#include "study/spec/study_file.h"
#include "study/spec/toml_reader.h"

namespace gnomon::study {

/// A table of `[[sweep]]`: one key and its values. A study with such tables is run once for each
/// case, a combination of values. A file with one table may have it as `[sweep]`.
struct SweepTable {
  std::string key;   ///< any key of the file that an override may set
  std::string axis;  ///< the key itself, unless the file says better
  std::string with;  ///< the key of a table above, with which it steps; its own dimension if empty
};

inline StudyKeys keysOf(SweepTable& sweep) {
  using enum Enters;
  return {
      studyKey("key", &sweep.key, "any that `--set` takes, as `relief.height`", {}, required,
               nothing),
      studyKey("values",
               OwnCode{"a list, `\"FIRST:LAST:STEP\"`, or `\"log:FIRST:LAST:COUNT\"`, which "
                       "steps by a factor; both ends included"},
               "of the key, at least two: the study runs at each", {}, required, nothing),
      studyKey("axis", &sweep.axis, "label of the plots' axis", {}, "the key", nothing),
      studyKey("with", &sweep.with, "the key of a table above: both step together, value by value",
               {}, "each value with all those of the other tables", nothing)};
}

/// What all tables together ask for.
struct Sweep {
  std::vector<SweptKey> keys;    ///< in the order of the file
  std::vector<SweepCase> cases;  ///< one a step; the first dimension changes slowest
};

/// What a study file asks for: one study, or one for each case of its sweep.
struct StudyPlan {
  std::string name;  ///< of the file's study
  std::string title, source;
  std::optional<Sweep> sweep;
  /// One, without a sweep. A step of a sweep is the file with `key=value` of each key as its last
  /// overrides; it is named `NAME/CASE` (caseNames), so that its folder lies in the sweep's. Given
  /// masks are those of their folder's subfolder CASE.
  std::vector<StudySpec> steps;
};

/// Whether a step of a plan is wanted, by its place among all of them; each is, where it is empty.
using StepFilter = std::function<bool(std::size_t step)>;

/// Reads and checks a study file with all its steps, or with those that are wanted.
/// @throws InputError as readStudy and readSweepTables; for a value that its key cannot take: all
///   name file, line and key
StudyPlan readStudyPlan(const std::filesystem::path& file, const StudyOptions& options = {},
                        const StepFilter& wants = {});

/// The most values of a key.
constexpr std::size_t mostSweepValues = 100'000;

/// The values of a `[[sweep]]` table: a list of numbers, of texts, of true and false, or of flat
/// lists; or a text that stands for numbers:
///   "5:85:5"           first, last and step: first + i·step up to the last, which must be one of
///                      them; a last below the first goes with a step below 0
///   "log:0.001:0.1:7"  first, last and count: first·(last/first)^(i/(count - 1)), both above 0
/// Numbers of a range are rounded to 12 digits, those of a geometric one to 6: so that they read
/// well, and are the same on every machine. First and last are as they are written.
/// @throws InputError for anything else, and for over mostSweepValues values
std::vector<SweptValue> sweepValues(const TomlReader& section, std::string_view key);

}  // namespace gnomon::study
