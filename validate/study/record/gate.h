#pragma once

#include <toml++/toml.h>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "common/error.h"
#include "compare/metric.h"

namespace gnomon::study {

/// Which of a method's two answers a figure is of (`MethodAnswers`): `drawn` is the score.
enum class Answer { drawn, test };

/// Both, the score first.
constexpr std::array<Answer, 2> allAnswers = {Answer::drawn, Answer::test};

/// "drawn", "test".
std::string_view answerName(Answer answer);
/// The answer of a name; none for another text.
std::optional<Answer> answerOfName(std::string_view name);

/// The limits that a run is checked against, and the results of the checks.

/// The limit is a `[[threshold]]` of a study's file.
struct Threshold {
  int line = 0;              ///< of its table; 0 for one that an override made
  bool quick = true;         ///< holds for the quick form too; otherwise for the full one only
  toml::table written = {};  ///< its table
  bool operator==(const Threshold&) const = default;
};

/// The limits follow from a committed value of the study's references (gates.h).
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

/// On a claim. `equal` and `noInterval` as in DifferenceVerdict.
enum class Verdict { held, failed, equal, notDistinguishable, noInterval, notEvaluated };

/// The least, the greatest and the quartiles between them.
struct Quartiles {
  double least = 0;
  double first = 0;
  double median = 0;
  double third = 0;
  double most = 0;
};

/// Linear between the two nearest of the sorted values; none of no value.
std::optional<Quartiles> quartilesOf(std::vector<double> values);

/// The results of a claim over the cases of its study. A case is one view under one light.
struct ClaimSpread {
  std::size_t cases = 0;   ///< in which the claim's metric is defined
  std::size_t held = 0;    ///< it holds there, distinguishably
  std::size_t failed = 0;  ///< the opposite holds there, distinguishably
  std::size_t views = 1;   ///< that the cases are from
  /// What the quartiles are of: "ratio", the claim's `less` over its `than` in each case where that
  /// is above 0; or "value", of its `method`.
  std::string quantity;
  std::optional<Quartiles> quartiles;  ///< none where no case has the quantity
  bool hasIntervals = false;  ///< false: judged by the truth's uncertainty alone, see judgeClaims
  /// Of the mean over all cases, by its own interval; none without intervals, or of one case.
  std::optional<Verdict> together = std::nullopt;
  std::size_t equal = 0;            ///< cases in which both methods give the same answers
  std::size_t withoutInterval = 0;  ///< cases in which too little is known

  /// The cases with none of these.
  [[nodiscard]] std::size_t notDistinguishable() const {
    return cases - held - failed - equal - withoutInterval;
  }
};

/// "held", "failed", "equal", "not distinguishable", "no interval" or "not evaluated": the same in
/// every kind of report.
std::string_view verdictName(Verdict verdict);

/// "holds for all lights together; holds under 25 of 27 lights, fails under 1, equal under 1, no
/// interval under 1; ratio 0.48 (0.30 to 0.90, quartiles 0.41 and 0.60)": what is true of no case
/// is left out, save for "fails"; the median, then the least and the greatest where there are
/// several cases, and the quartiles from four cases on. Over several views "for all cases together;
/// holds in 25 of 54".
std::string spreadText(const ClaimSpread& spread);

}  // namespace gnomon::study
