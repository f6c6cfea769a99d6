#pragma once

#include <string>
#include <vector>

#include "study/record/record.h"

namespace gnomon {

/// A value as it names a step: "0.0025".
std::string sweepValueText(double value);

/// What a sweep found: one study, run once for each value of one key.
struct SweepRecord {
  std::string name;  ///< its folder, in which every step's is named by its value
  std::string title;
  std::string source;
  std::string file;
  std::string command;
  std::string copy;  ///< name of the study's copy in its folder
  std::string key;   ///< as `--set` takes it
  std::string axis;  ///< what its values are, for a plot's axis
  std::vector<double> values;
  std::vector<StudyRecord> steps;   ///< one a value, in their order
  std::vector<ClaimRecord> claims;  ///< judged over all steps

  /// The title, or the name of a study without one.
  [[nodiscard]] const std::string& heading() const { return title.empty() ? name : title; }
  /// What the gates of all steps say together.
  [[nodiscard]] RunStatus status() const;
  /// The notices of all steps, each once; where only some steps have it, with their values.
  [[nodiscard]] std::vector<std::string> notices() const;
};

}  // namespace gnomon
