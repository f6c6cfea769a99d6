#pragma once

#include <optional>
#include <span>
#include <string>

#include "common/error.h"
#include "study/record/answer.h"

namespace gnomon {

/// What a run is judged by, and what became of it.

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

/// Why something of a study could not be judged.
struct ProblemRecord {
  std::string part;  ///< "study", "baseline", or "method" for one that was refused
  ExitStatus status = ExitStatus::internal;
  std::string message;
};

/// The largest of the problems' statuses; pass without any.
ExitStatus worstOf(std::span<const ProblemRecord> problems);

/// What a run's gates say of it, for the exit status of a check, its summary and its report alike.
enum class RunStatus {
  pass,       ///< a gate passed, all others passed or were skipped, and there was no problem
  fail,       ///< a gate failed or was undefined, or there was a problem
  notJudged,  ///< no gate judged it
};

RunStatus runStatus(std::span<const GateRecord> gates, std::span<const ProblemRecord> problems);

}  // namespace gnomon
