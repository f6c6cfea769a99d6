#pragma once

#include <string>
#include <vector>

#include "common/error.h"
#include "study/record/gate.h"
#include "study/record/record.h"

namespace gnomon {

/// What a check found: gates, each with what became of it, and what kept it from judging.

/// The gate that a run judged.
GateRecord gateOf(const ThresholdRecord& threshold, const std::string& step);

/// All gates that judged a run: its thresholds, then its references.
std::vector<GateRecord> gatesOf(const StudyRecord& record);

/// What somebody may want to do, and where; it decides nothing.
struct NoticeRecord {
  std::string text;
  int line = 0;  ///< in the study's file
};

/// The check of one study file.
struct CheckRecord {
  std::string name;     ///< the study's; its file's stem, where that could not be read
  std::string file;     ///< as given
  std::string command;  ///< reproduces its check
  double seconds = 0;   ///< that the run's stages took
  std::vector<GateRecord> gates;
  std::vector<NoticeRecord> notices;
  std::vector<ProblemRecord> problems;
  std::string baseline;  ///< the file of its references; empty without

  /// pass only where runStatus is; else the largest of the problems' statuses and thresholdFailed.
  [[nodiscard]] ExitStatus status() const;
};

}  // namespace gnomon
