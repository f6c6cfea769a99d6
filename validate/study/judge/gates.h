#pragma once

#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "compare/counts.h"
#include "study/record/cases.h"
#include "study/record/gate.h"
#include "study/record/record.h"

namespace gnomon::study {

/// Checks a value against a gate: passed only if the metric is defined and finite, has a limit, and
/// `minimum <= value` and `value <= maximum` hold; undefined without a finite value, whatever the
/// limits.
Judgement judge(Gate gate, const compare::Metric& found);

/// Judges every threshold on every row of the record that it matches.
/// @throws InputError for a threshold that matches no row, since it could never fail
std::vector<Judgement> judgeThresholds(std::span<const Gate> thresholds, const StudyRecord& record);

/// A notice for each limit that could be tightened: its nearest value, over all rows and steps that
/// it applies to, is farther from it than a quarter of the limit and four times `toleranceOf`.
/// There is none for a limit with a failed or undefined row.
/// @param steps  the records of the study's steps, each with its judgements
std::vector<NoticeRecord> looseThresholds(std::span<const Gate> thresholds,
                                          std::span<const StudyRecord> steps);

/// The committed values of a study, and the check that a run is not worse than they are.
///
/// A run is deterministic on one OpenGL, so the measured spread of a value is the truth's own
/// uncertainty for its view and light: the share of samples that flip at half the micro-mesh's
/// resolution, and of lengths their error there. The tolerance is twice the spread, and at least
/// leastRateTolerance or leastLengthTolerance: room for a processor that rounds otherwise.

/// What a value may differ by from one processor to another: rounded up from the largest difference
/// of a rate, 0.00148, and of a length ratio, 0.0336, over the 48,900 values of all scenes, between
/// AVX-512 and SSE2 (docs/reproducing.md). Two releases of Debian differ by less.
inline constexpr double leastRateTolerance = 0.0015;
inline constexpr double leastLengthTolerance = 0.035;

/// Why values were written, from the first time on.
struct BaselineReason {
  std::string text;
  std::string gnomonVersion;
  std::string commit;           ///< of Gnomon's sources
  std::string repository = {};  ///< commit of the user's repository; empty where there is none
};

struct Baseline {
  std::string study;
  bool quick = false;             ///< values of the quick form, not the full one
  EnvironmentRecord environment;  ///< of the run that they are of
  std::vector<BaselineReason> history;
  std::vector<Gate> gates;  ///< one a committed value, as referenceGate makes it
};

/// The metrics that a baseline holds: error_rate, false_shadow and false_light, which may not rise;
/// shadow_length_ratio, which may not move away from 1; and prevalence, which is the truth's own
/// and may not move at all.
/// Of the answer of the shadow test alone a baseline holds the first three.
std::span<const compare::MetricId> baselineMetrics(Answer answer);

/// The measured spread of any metric in one case; none for a length or boundary whose error was not
/// measured.
std::optional<double> spreadOf(const StudyRecord& record, const Case& which,
                               compare::MetricId metric);

/// The tolerance for a spread: max(2 × spread, least tolerance). Metrics of boundaries have the
/// least tolerance of rates.
double toleranceOf(compare::MetricId metric, double spread);

/// The gate of a committed value: its limits are as far from the value, on the side or sides where
/// the metric is worse, as the tolerance says. It is of the region "all".
/// @param row  step, method, light, view, answer and metric of the value
Gate referenceGate(Gate row, const Reference& reference);

/// What identifies a committed value: no two values of a baseline have the same key.
/// @param gate  outlives the key
inline auto valueKey(const Gate& gate) {
  return std::tie(gate.step, gate.method, gate.light, gate.view, gate.answer, gate.metric);
}

/// The committed value of a reference gate, with its spread and tolerance.
/// @throws std::bad_variant_access for a gate of another origin
const Reference& referenceOf(const Gate& gate);

/// Whether the gate of a committed value can fail at all: a limit of it lies inside the metric's
/// range, and of a length the tolerance is below 1. Where the truth is too uncertain for that,
/// there are no references.
bool canFail(const Gate& reference);

/// The gates of all values that a baseline holds of a study's run: those that are defined, whose
/// spread is measured, and whose gate can fail.
/// @param steps  one record, or one for each step of a sweep
std::vector<Gate> referenceGates(std::span<const StudyRecord> steps);

/// Judges one run by the committed values of its step: failed where it is worse by more than the
/// tolerance, undefined where the run has no value or its method was refused.
/// @param leftOut  labels of the methods that the run leaves out: their gates are skipped
/// @throws InputError where baseline and run have different rows: a reference is missing, or is for
///   something that the run does not have
std::vector<Judgement> judgeBaseline(const Baseline& baseline, const StudyRecord& record,
                                     const std::vector<std::string>& leftOut);

/// A notice for each value that improved by more than its tolerance: its reference could be
/// tightened.
std::vector<NoticeRecord> betterThan(std::span<const Judgement> references);

}  // namespace gnomon::study
