#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

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

}  // namespace gnomon::study
