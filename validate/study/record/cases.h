#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "study/record/gate.h"
#include "study/record/record.h"

namespace gnomon::study {

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
