#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "study/record/record.h"

namespace gnomon::study {

/// The only rule for whether two figures differ. Verdicts, the signs in all tables, LaTeX,
/// rankings, statistics over scenes, error budgets and claims use it.

/// A figure, or a difference of two figures, with its uncertainty.
struct Estimate {
  double value = 0;
  /// 95 %, of the value; none where too little is known. Of a difference over the scenes of a suite
  /// (judge/suite) that over the scenes, as wide as Holm's correction asks of the comparison.
  std::optional<compare::Interval> interval;
  double uncertainty = 0;  ///< of the truth, in the figure's unit
  bool areEqual = false;   ///< a difference of two methods that answer alike, to the sample
};

/// Of a metric that has no intervals (all but the error rate of all samples): only the truth's
/// uncertainty counts.
Estimate withoutInterval(double value, double uncertainty);

/// How a figure compares with a number. In this order: the difference of methods that answer alike
/// is `equal` to 0; a figure is not distinguishable from a number that is no further away than the
/// truth's uncertainty; without an interval nothing can be said; the two are not distinguishable
/// where the interval holds the number; otherwise the smaller one is better. Of a difference of two
/// figures, compared with 0, the verdict is that on the first.
DifferenceVerdict distinguish(const Estimate& estimate, double number = 0);

/// The verdict on the second of two methods.
DifferenceVerdict opposite(DifferenceVerdict verdict);

/// Whether the verdict is better or worse.
bool isDistinguishable(DifferenceVerdict verdict);
bool isDistinguishable(const Estimate& estimate, double number = 0);

/// Labels of the methods that one is not known to differ from, by the verdict on the difference.
struct LikeMethods {
  std::vector<std::string> equal, close, withoutInterval;

  /// Nothing for a method that is better or worse.
  void add(const std::string& label, DifferenceVerdict verdict);
};

Estimate estimateOf(const DifferenceRecord& difference);

/// Whether it has an interval, or is 0 as both methods answer alike.
bool isKnown(const DifferenceRecord& difference);

/// The same difference with the two methods exchanged.
DifferenceRecord swapped(DifferenceRecord difference);

/// All differences of a record in one view, in its order.
/// @param light  a light's name, or "all"; the only light of a study is both
std::vector<DifferenceRecord> differencesIn(const StudyRecord& record, std::string_view view,
                                            std::string_view light);

/// Two methods in one view of a record, the first less the second, whichever of them the record
/// names first; none where it has no such pair.
/// @param light  as differencesIn
std::optional<DifferenceRecord> differenceOf(const StudyRecord& record, std::string_view view,
                                             std::string_view light, std::string_view first,
                                             std::string_view second);

/// A method's error rate in one view, with its interval; none where the record has none.
/// @param light  as differencesIn
std::optional<ConfidenceRecord> findConfidence(const StudyRecord& record, std::string_view view,
                                               std::string_view light, std::string_view method);

/// The mean interval of a method's error rate over views, all lights together: the mean of the
/// ends, as if all errors were fully correlated, so never too narrow. None where a view has none,
/// and without any view.
std::optional<compare::Interval> meanInterval(const StudyRecord& record, std::string_view method,
                                              const std::set<std::string>& views);

/// The mean of differences of the same two methods: of their differences, of their intervals' ends
/// (as if all errors were fully correlated, so never too narrow) and of the truth's uncertainties.
/// Equal ones have the interval 0 to 0. One without an interval may be anything from -1 to 1: where
/// the mean is better or worse all the same, it has that interval, else none, and the first reason.
/// @param all  one or more
DifferenceRecord meanDifference(const std::vector<DifferenceRecord>& all);

/// Of every two methods the mean over the views in which both answer, all lights together; in the
/// order of the labels, without the pairs that share no view.
/// @param labels  of the methods, each once
std::vector<DifferenceRecord> differencesOverViews(const StudyRecord& record,
                                                   const std::vector<std::string>& labels);

/// That of two methods, the first less the second; none where they share no view.
std::optional<DifferenceRecord> differenceOverViews(const StudyRecord& record,
                                                    std::string_view first,
                                                    std::string_view second);

}  // namespace gnomon::study
