#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compare/counts.h"
#include "study/record/gate.h"
#include "study/record/record.h"

namespace gnomon::study {

/// All metrics of one result: its rates, the boundaries of its shadows, their lengths, and of a
/// light with a disc, over all samples, its share metrics. Under such a light the rates are those
/// of the shares (see compare::Counts), boundaries and lengths those of the masks that they are cut
/// to.
/// @throws InternalError as `rates`
std::vector<compare::Metric> metricsOf(const ResultRecord& result);

/// One of them.
compare::Metric metricOf(const ResultRecord& result, compare::MetricId id);

/// The truth's uncertainty in a metric that is no rate (there it is the share of samples that
/// flip): how far the coarser truth's figure is from that of a perfect mask. For lengths this is
/// `lengthError`; a perfect mask has distance 0 between boundaries, and 1 as boundary IoU and
/// surface Dice (MetricId::perfect). Infinite where the coarser truth has no boundary to compare,
/// so that nothing can be told apart; 0 where its lengths could not be measured.
/// @throws InternalError for a rate
double metricUncertainty(const UncertaintyRecord& truth, compare::MetricId id);

/// The region that holds every sample.
constexpr std::string_view wholeRegion = "all";

/// One view under one light.
struct Case {
  std::string view;
  std::string light;
  bool operator==(const Case&) const = default;
};

/// The cases of a record, in the order in which its results first name them.
std::vector<Case> casesOf(const StudyRecord& record);

/// The cases in which at least one method's drawn answer has an error rate: rankings use these.
std::vector<Case> comparedCases(const StudyRecord& record);

/// The labels of the methods that have results: as `methods` lists them, then any others.
std::vector<std::string> methodsOf(const StudyRecord& record);

/// The regions of one case, in the order of the results.
std::vector<std::string> regionsOf(const StudyRecord& record, const Case& which);

/// The row of one method's answer, or nullptr.
const ResultRecord* findResult(const StudyRecord& record, std::string_view method,
                               const Case& which, std::string_view region = wholeRegion,
                               Answer answer = Answer::drawn);

/// A rate of one method's answer over all samples, undefined where there is no such row.
std::optional<double> rateOf(const StudyRecord& record, std::string_view method, const Case& which,
                             Answer answer, compare::MetricId metric);

/// The measured uncertainty of the truth in a case, or nullptr.
const UncertaintyRecord* findUncertainty(const StudyRecord& record, const Case& which);

/// The share of samples whose truth changes at half resolution in this case. If the run did not
/// measure the case, its largest share; none, if it measured no case.
std::optional<double> uncertaintyOf(const StudyRecord& record, const Case& which);

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
