#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "study/record/gate_record.h"
#include "study/record/record.h"

namespace gnomon {

/// The committed values of a study, and the check that a run has become no worse.
///
/// A run is deterministic on one OpenGL, so the measured spread of a value is the truth's own
/// uncertainty for its view and light: the share of samples that flip at half the micro-mesh's
/// resolution, and of lengths their error there. The tolerance is twice the spread, and at least
/// 0.001 for rates and 0.02 for length ratios: room for an OpenGL that rounds otherwise.

/// One committed value, of the region "all".
struct BaselineEntry {
  std::string step;  ///< the study's name, or that of a sweep's step
  std::string method, light, view, metric;
  double value = 0;
  double spread = 0;     ///< measured, as above
  double tolerance = 0;  ///< more than the spread
  Answer answer = Answer::drawn;
  bool operator==(const BaselineEntry&) const = default;
};

/// Why values were written, from the first time on.
struct BaselineReason {
  std::string text;
  std::string gnomonVersion;
  std::string commit;
};

struct Baseline {
  std::string study;
  bool quick = false;             ///< values of the quick form, not the full one
  EnvironmentRecord environment;  ///< of the run that they are of
  std::vector<BaselineReason> history;
  std::vector<BaselineEntry> entries;
};

/// The metrics that a baseline holds: error_rate, false_shadow and false_light, which may not rise;
/// shadow_length_ratio, which may not move away from 1; and prevalence, which is the truth's own
/// and may not move at all.
/// Of the answer of the shadow test alone a baseline holds the first three.
std::span<const std::string_view> baselineMetrics(Answer answer);

/// Whether a metric is one of lengths (lengthMetrics), at least 0. Of a baseline's metrics all
/// others are shares, 0 to 1.
bool isLengthMetric(std::string_view metric);

/// The measured spread of a metric of one result, of any metric; none for a length or boundary
/// whose error was not measured.
std::optional<double> spreadOf(const StudyRecord& record, const ResultRecord& result,
                               std::string_view metric);

/// The tolerance for a spread: that of rates also for the metrics of boundaries.
double toleranceOf(std::string_view metric, double spread);

/// Whether the gate of a committed value can fail at all: a limit of it lies inside the metric's
/// range, and of a length the tolerance is below 1. A truth that is uncertain by that much has no
/// references.
bool canFail(const BaselineEntry& entry);

/// All values that a baseline holds of a study's run: those that are defined, whose spread is
/// measured, and whose gate can fail.
/// @param steps  one record, or one for each step of a sweep
std::vector<BaselineEntry> referenceValues(std::span<const StudyRecord> steps);

/// Judges a run by its baseline: a gate for each committed value, failed where it is worse by more
/// than the tolerance, undefined where the run has none or its method was refused.
/// @param leftOut  labels of the methods that the run takes no part of: their gates are skipped
/// @throws InputError where the two do not speak of the same rows: a reference that is missing, or
///   one for something that the run does not have
std::vector<GateRecord> judgeBaseline(const Baseline& baseline, std::span<const StudyRecord> steps,
                                      const std::vector<std::string>& leftOut);

/// What became better by more than the tolerance, so that its reference could be tightened.
std::vector<NoticeRecord> betterThan(const Baseline& baseline,
                                     const std::vector<GateRecord>& gates);

}  // namespace gnomon
