#pragma once

#include <string>
#include <vector>

#include "study/record/record.h"
#include "study/record/swept_value.h"

namespace gnomon::study {

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
