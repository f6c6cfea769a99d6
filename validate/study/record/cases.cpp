#include "study/record/cases.h"

#include <algorithm>

#include "common/lists.h"
#include "compare/counts.h"

namespace gnomon::study {

namespace {

bool belongsTo(const ResultRecord& result, const Case& which) {
  return result.view == which.view && result.light == which.light;
}

}  // namespace

std::vector<Case> casesOf(const StudyRecord& record) {
  std::vector<Case> cases;
  for (const ResultRecord& result : record.results) {
    appendOnce(cases, Case{result.view, result.light});
  }
  return cases;
}

std::vector<std::string> methodsOf(const StudyRecord& record) {
  std::vector<std::string> withResults;
  for (const ResultRecord& result : record.results) appendOnce(withResults, result.method);
  std::vector<std::string> methods;
  for (const MethodRecord& method : record.methods) {
    if (contains(withResults, method.label)) appendOnce(methods, method.label);
  }
  for (const std::string& label : withResults) appendOnce(methods, label);
  return methods;
}

std::vector<Case> comparedCases(const StudyRecord& record) {
  std::vector<Case> cases = casesOf(record);
  const std::vector<std::string> labels = methodsOf(record);
  std::erase_if(cases, [&](const Case& which) {
    return std::none_of(labels.begin(), labels.end(), [&](const std::string& label) {
      return rateOf(record, label, which, Answer::drawn, compare::metrics::errorRate);
    });
  });
  return cases;
}

std::vector<std::string> regionsOf(const StudyRecord& record, const Case& which) {
  std::vector<std::string> regions;
  for (const ResultRecord& result : record.results) {
    if (belongsTo(result, which)) appendOnce(regions, result.region);
  }
  return regions;
}

const ResultRecord* findResult(const StudyRecord& record, std::string_view method,
                               const Case& which, std::string_view region, Answer answer) {
  const auto found = std::find_if(record.results.begin(), record.results.end(), [&](const auto& r) {
    return r.method == method && r.region == region && r.answer == answer && belongsTo(r, which);
  });
  return found == record.results.end() ? nullptr : &*found;
}

std::optional<double> rateOf(const StudyRecord& record, std::string_view method, const Case& which,
                             Answer answer, compare::MetricId metric) {
  const ResultRecord* row = findResult(record, method, which, wholeRegion, answer);
  return row == nullptr ? std::nullopt : compare::rate(row->counts, metric).value;
}

const UncertaintyRecord* findUncertainty(const StudyRecord& record, const Case& which) {
  const auto& flips = record.truth.flips;
  const auto found = std::find_if(flips.begin(), flips.end(), [&](const UncertaintyRecord& flip) {
    return flip.view == which.view && flip.light == which.light;
  });
  return found == flips.end() ? nullptr : &*found;
}

std::optional<double> uncertaintyOf(const StudyRecord& record, const Case& which) {
  if (const UncertaintyRecord* flip = findUncertainty(record, which)) return flip->flipRate;
  const bool measured = !record.truth.flips.empty() || record.truth.uncertainty > 0;
  return measured ? std::optional(record.truth.uncertainty) : std::nullopt;
}

}  // namespace gnomon::study
