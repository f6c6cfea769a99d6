#pragma once

#include <toml++/toml.h>

#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "common/error.h"
#include "compare/metric.h"
#include "study/record/answer.h"

namespace gnomon::study {

/// The limits that a run is checked against, and the results of the checks.

/// The limit is a `[[threshold]]` of a study's file.
struct Threshold {
  int line = 0;              ///< of its table; 0 for one that an override made
  bool quick = true;         ///< holds for the quick form too; otherwise for the full one only
  toml::table written = {};  ///< its table
  bool operator==(const Threshold&) const = default;
};

/// The limits follow from a committed value of the study's references (baseline.h).
struct Reference {
  double committed = 0;
  double spread = 0;     ///< measured with it: how uncertain the truth was
  double tolerance = 0;  ///< by which the value may become worse; more than the spread
  bool operator==(const Reference&) const = default;
};

/// The limit is an option of `gnomon compare`.
struct CompareOption {
  std::string text;  ///< as typed: "--max error_rate=0.02"
  bool operator==(const CompareOption&) const = default;
};

/// A limit on one metric of one answer of a method. In a threshold, an empty method, light or view
/// stands for all of them.
struct Gate {
  std::string method, light, view, region;
  compare::MetricId metric = compare::metrics::errorRate;
  std::optional<double> minimum, maximum;  ///< both included
  std::variant<Threshold, Reference, CompareOption> origin = {};
  Answer answer = Answer::drawn;
  std::string step = {};  ///< name of the study that is judged, or of a sweep's step (`NAME/VALUE`)
  bool operator==(const Gate&) const = default;
};

/// Only `passed` lets a check pass. `undefined`: there was no number to judge.
enum class GateVerdict { passed, failed, undefined, skipped };

/// The result of checking a gate (judge in study/judge/gates.h).
struct Judgement {
  Gate gate;  ///< with the names of the row that was checked; a skipped gate as the file has it
  GateVerdict verdict = GateVerdict::undefined;
  std::optional<double> value = std::nullopt;  ///< finite; none where it is undefined or skipped
  std::string reason = {};                     ///< why it is undefined or skipped

  /// The value's distance from the nearest limit: below 0 by how much it fails, none without a
  /// value.
  [[nodiscard]] std::optional<double> margin() const;
  /// Failed or undefined: the check does not pass.
  [[nodiscard]] bool isFault() const;
};

/// The value in the name of a sweep's step, `NAME/VALUE`; empty in the name of a study.
std::string stepValue(const std::string& step);

/// The committed value of a reference; none of a gate of another origin.
std::optional<double> committedValue(const Gate& gate);

/// Judgements by the origins of their gates, each list in its order. A report that shows all lists
/// takes them apart, `const auto [thresholds, references, options] = byOrigin(judgements)`: with a
/// further origin it does not compile until it shows that too.
struct JudgementsByOrigin {
  std::vector<Judgement> thresholds, references, options;
};
JudgementsByOrigin byOrigin(std::span<const Judgement> judgements);

/// An error that kept a part of a study from being judged.
struct ProblemRecord {
  std::string part;  ///< "study", "baseline", or "method" for one that was refused
  ExitStatus status = ExitStatus::internal;
  std::string message;
};

/// The largest of the problems' statuses; pass without any.
ExitStatus worstOf(std::span<const ProblemRecord> problems);

/// The result of all gates of a run, which exit status, summary and report share.
enum class RunStatus {
  pass,       ///< a gate passed, all others passed or were skipped, and there was no problem
  fail,       ///< a gate failed or was undefined, or there was a problem
  notJudged,  ///< no gate judged it
};

RunStatus runStatus(std::span<const Judgement> judgements, std::span<const ProblemRecord> problems);

}  // namespace gnomon::study
