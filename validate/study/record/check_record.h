#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "study/record/gate.h"

namespace gnomon::study {

/// Advice, and the place in the study's file that it is about. It does not change the result of a
/// check.
struct NoticeRecord {
  std::string text;
  int line = 0;  ///< in the study's file
};

/// The check of one study file: the results of its gates, and the errors that kept it from judging.
struct CheckRecord {
  std::string name;     ///< the study's; its file's stem, where that could not be read
  std::string file;     ///< as given
  std::string command;  ///< reproduces its check
  double seconds = 0;   ///< that the run's stages took
  std::vector<Judgement> judgements;
  std::vector<NoticeRecord> notices;
  std::vector<ProblemRecord> problems;
  std::string baseline;  ///< the file of its references; empty without
  /// The shaders that are the user's own, not Gnomon's: the file of each such method, by its label.
  std::map<std::string, std::string> shaders;

  /// pass only where runStatus is; else the largest of the problems' statuses and thresholdFailed.
  [[nodiscard]] ExitStatus status() const {
    if (runStatus(judgements, problems) == RunStatus::pass) return ExitStatus::pass;
    return std::max(ExitStatus::thresholdFailed, worstOf(problems));
  }
};

}  // namespace gnomon::study
