#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "study/record/record.h"

namespace gnomon::study {

/// The keys of a sweep, and what its cases give to them.

/// A value of a key.
struct SweptValue {
  std::string text;              ///< as people read it: "0.0025", "columns", "[64, 64]"
  std::optional<double> number;  ///< where it is one
  std::string written;           ///< as a study's file has it: "0.0025", "\"columns\""
  bool operator==(const SweptValue&) const = default;
};

/// A number as a value: its shortest text.
SweptValue sweptNumber(double number);

/// A key that a sweep sets.
struct SweptKey {
  std::string key;   ///< as `--set` takes it
  std::string axis;  ///< what its values are, for a plot's axis
  /// Keys of one dimension step together: they are zipped. The dimensions make a grid.
  /// From 0, in the order of the file.
  std::size_t dimension = 0;
};

/// One point of a sweep.
struct SweepCase {
  std::string name;                ///< its folder in the sweep's
  std::vector<SweptValue> values;  ///< one a key
};

/// The number of dimensions of a sweep.
std::size_t dimensionCount(std::span<const SweptKey> keys);

/// "relief.height = 2", with several keys "relief.height = 2, bake.bits = 8".
std::string caseText(std::span<const SweptKey> keys, const SweepCase& which);

/// The last part of each key, "height"; the whole key where two end alike, also for who takes a
/// letter and its capital for one.
std::vector<std::string> shortNames(std::span<const SweptKey> keys);

/// "relief.height", with several keys "relief.height, bake.bits".
std::string keysText(std::span<const SweptKey> keys);

/// What a sweep found: one study, run once for each case.
struct SweepRecord {
  std::string name;  ///< its folder, in which every step's has the name of its case
  std::string title;
  std::string source;
  std::string file;
  std::string command;
  std::string copy;  ///< name of the study's copy in its folder
  std::vector<SweptKey> keys;
  std::vector<SweepCase> cases;
  std::vector<StudyRecord> steps;   ///< one a case, in their order
  std::vector<ClaimRecord> claims;  ///< judged over all steps
  bool hasStepReports = true;       ///< whether each step has a folder of its own

  /// The title, or the name of a study without one.
  [[nodiscard]] const std::string& heading() const { return title.empty() ? name : title; }
  /// What the gates of all steps say together.
  [[nodiscard]] RunStatus status() const;
  /// Those of the steps, each once; with the cases that it holds in, where these are not all.
  [[nodiscard]] std::vector<std::string> notices() const;
  /// Some of its cases for a sentence: of one key their values, "2, 4"; of several their names. Of
  /// many the first and how many more.
  [[nodiscard]] std::string casesText(const std::vector<std::size_t>& which) const;
};

}  // namespace gnomon::study
