#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/error.h"
#include "study/record.h"
#include "study/study_file.h"

namespace gnomon {

/// What a check found: gates, each with what became of it, and what kept it from judging.

enum class GateKind {
  threshold,  ///< a `[[threshold]]` of the study
  reference,  ///< a committed value of its baseline
};

/// Only `passed` lets a check pass. `undefined`: there was no number to judge.
enum class GateVerdict { passed, failed, undefined, skipped };

/// One limit on one value. `step` is the name of the study, or of a sweep's step (`NAME/VALUE`).
struct GateRecord {
  GateKind kind = GateKind::threshold;
  std::string step;
  std::string method, light, view, region, metric;  ///< of a skipped gate: as its filter has them
  std::optional<double> value;
  std::optional<double> minimum, maximum;
  GateVerdict verdict = GateVerdict::undefined;
  std::string reason;                   ///< why it is undefined or skipped
  int line = 0;                         ///< of a threshold, in the study's file
  std::optional<double> expected = {};  ///< the committed value of a reference
  Answer answer = Answer::drawn;

  /// The value's distance from the nearest limit: below 0 by how much it fails, none without a
  /// value.
  [[nodiscard]] std::optional<double> margin() const;
};

/// A judged value: undefined without one or where it is not finite, failed unless `minimum <=
/// value` and `value <= maximum`.
GateVerdict verdictOf(const GateRecord& gate);

/// The gate that a run judged.
GateRecord gateOf(const ThresholdRecord& threshold, const std::string& step);

/// The gate that it was not to judge.
GateRecord gateOf(const LeftOutThreshold& threshold, const std::string& step);

/// What somebody may want to do, and where; it decides nothing.
struct NoticeRecord {
  std::string text;
  int line = 0;  ///< in the study's file
};

/// Why something of a study could not be judged.
struct ProblemRecord {
  std::string part;  ///< "study" or "baseline"
  ExitStatus status = ExitStatus::internal;
  std::string message;
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

  /// pass only if it has a gate that passed, and all others passed or were skipped, and there is no
  /// problem; else the largest of the problems' statuses and thresholdFailed.
  [[nodiscard]] ExitStatus status() const;
};

}  // namespace gnomon
