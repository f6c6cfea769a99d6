#include "study/record/cases.h"

#include <cmath>
#include <limits>

#include "common/lists.h"
#include "compare/answer_metrics.h"
#include "compare/boundaries.h"

namespace gnomon::study {
namespace {

using compare::MetricKind;

constexpr std::string_view notInRegions = "measured over all samples together only";
constexpr std::string_view notOfShares =
    "measured over all samples together under a soft light only";

std::vector<compare::Metric> unmeasured(std::initializer_list<MetricKind> kinds,
                                        std::string_view reason = notInRegions) {
  std::vector<compare::Metric> metrics;
  for (const compare::MetricId id : compare::metricsOfKinds(kinds)) {
    metrics.push_back({id, {}, reason});
  }
  return metrics;
}

std::vector<compare::Metric> sharesOf(const std::vector<compare::Metric>& measured) {
  return measured.empty() ? unmeasured({MetricKind::share, MetricKind::penumbra}, notOfShares)
                          : measured;
}

std::vector<compare::Metric> boundariesOf(const std::vector<compare::Metric>& measured) {
  return measured.empty() ? unmeasured({MetricKind::boundary}) : measured;
}

std::vector<compare::Metric> lengthsOf(const ResultRecord& result) {
  return result.lengths ? compare::lengthMetrics(*result.lengths)
                        : unmeasured({MetricKind::length});
}

bool isOfShares(compare::MetricId id) {
  return id.kind() == MetricKind::share || id.kind() == MetricKind::penumbra;
}

}  // namespace

std::vector<compare::Metric> metricsOf(const ResultRecord& result) {
  std::vector<compare::Metric> metrics = compare::rates(result.counts);
  for (const auto& more : {boundariesOf(result.boundaries), lengthsOf(result), result.shares}) {
    metrics.insert(metrics.end(), more.begin(), more.end());
  }
  return metrics;
}

compare::Metric metricOf(const ResultRecord& result, compare::MetricId id) {
  if (id.kind() == MetricKind::rate) return compare::rate(result.counts, id);
  return compare::metricNamed(isOfShares(id)                    ? sharesOf(result.shares)
                              : id.kind() == MetricKind::length ? lengthsOf(result)
                                                                : boundariesOf(result.boundaries),
                              id);
}

double metricUncertainty(const UncertaintyRecord& truth, compare::MetricId id) {
  if (id.kind() == MetricKind::length) return truth.lengthError.value_or(0);
  const auto value =
      compare::metricNamed(isOfShares(id) ? sharesOf(truth.shares) : boundariesOf(truth.boundaries),
                           id)
          .value;
  return value ? std::abs(*value - id.perfect()) : std::numeric_limits<double>::infinity();
}

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
