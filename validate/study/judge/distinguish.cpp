#include "study/judge/distinguish.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

namespace gnomon::study {
namespace {

/// A study with one light has records for all lights together only.
bool isOnlyLight(const StudyRecord& record, std::string_view view) {
  return std::none_of(record.confidence.begin(), record.confidence.end(),
                      [&](const auto& row) { return row.view == view && row.light != allLights; });
}

std::string_view rowLight(const StudyRecord& record, std::string_view view,
                          std::string_view light) {
  return isOnlyLight(record, view) ? allLights : light;
}

}  // namespace

Estimate withoutInterval(double value, double uncertainty) {
  return {value, compare::Interval{value, value}, uncertainty};
}

DifferenceVerdict opposite(DifferenceVerdict verdict) {
  switch (verdict) {
    case DifferenceVerdict::better:
      return DifferenceVerdict::worse;
    case DifferenceVerdict::worse:
      return DifferenceVerdict::better;
    default:
      return verdict;
  }
}

DifferenceVerdict distinguish(const Estimate& estimate, double number) {
  using enum DifferenceVerdict;
  const double distance = estimate.value - number;
  if (estimate.areEqual && number == 0) return equal;
  if (!(std::abs(distance) > estimate.uncertainty)) return notDistinguishable;
  if (!estimate.interval) return noInterval;
  if (estimate.interval->holds(number)) return notDistinguishable;
  return distance < 0 ? better : worse;
}

bool isDistinguishable(DifferenceVerdict verdict) {
  return verdict == DifferenceVerdict::better || verdict == DifferenceVerdict::worse;
}

bool isDistinguishable(const Estimate& estimate, double number) {
  return isDistinguishable(distinguish(estimate, number));
}

void LikeMethods::add(const std::string& label, DifferenceVerdict verdict) {
  if (verdict == DifferenceVerdict::equal) equal.push_back(label);
  if (verdict == DifferenceVerdict::notDistinguishable) close.push_back(label);
  if (verdict == DifferenceVerdict::noInterval) withoutInterval.push_back(label);
}

Estimate estimateOf(const DifferenceRecord& difference) {
  return {difference.difference, difference.interval, difference.uncertainty,
          difference.verdict == DifferenceVerdict::equal};
}

bool isKnown(const DifferenceRecord& difference) {
  return difference.interval || difference.verdict == DifferenceVerdict::equal;
}

DifferenceRecord swapped(DifferenceRecord difference) {
  std::swap(difference.first, difference.second);
  difference.difference = -difference.difference;
  if (difference.interval) {
    difference.interval = compare::Interval{-difference.interval->high, -difference.interval->low};
  }
  difference.verdict = opposite(difference.verdict);
  return difference;
}

std::vector<DifferenceRecord> differencesIn(const StudyRecord& record, std::string_view view,
                                            std::string_view light) {
  const std::string_view named = rowLight(record, view, light);
  std::vector<DifferenceRecord> rows;
  std::copy_if(record.differences.begin(), record.differences.end(), std::back_inserter(rows),
               [&](const auto& row) { return row.view == view && row.light == named; });
  return rows;
}

std::optional<DifferenceRecord> differenceOf(const StudyRecord& record, std::string_view view,
                                             std::string_view light, std::string_view first,
                                             std::string_view second) {
  const std::string_view named = rowLight(record, view, light);
  for (const DifferenceRecord& row : record.differences) {
    if (row.view != view || row.light != named) continue;
    if (row.first == first && row.second == second) return row;
    if (row.first == second && row.second == first) return swapped(row);
  }
  return std::nullopt;
}

std::optional<ConfidenceRecord> findConfidence(const StudyRecord& record, std::string_view view,
                                               std::string_view light, std::string_view method) {
  const std::string_view named = rowLight(record, view, light);
  const auto found =
      std::find_if(record.confidence.begin(), record.confidence.end(), [&](const auto& row) {
        return row.view == view && row.light == named && row.method == method;
      });
  return found == record.confidence.end() ? std::nullopt : std::optional(*found);
}

std::optional<compare::Interval> meanInterval(const StudyRecord& record, std::string_view method,
                                              const std::set<std::string>& views) {
  compare::Interval sum;
  for (const std::string& view : views) {
    const auto row = findConfidence(record, view, allLights, method);
    if (!row || !row->interval) return std::nullopt;
    sum = {sum.low + row->interval->low, sum.high + row->interval->high};
  }
  const auto count = static_cast<double>(views.size());
  return views.empty() ? std::nullopt
                       : std::optional(compare::Interval{sum.low / count, sum.high / count});
}

DifferenceRecord meanDifference(const std::vector<DifferenceRecord>& all) {
  const auto count = static_cast<double>(all.size());
  const auto unknown = std::find_if_not(all.begin(), all.end(), isKnown);
  Estimate estimate{0, compare::Interval{}, 0, true};
  for (const DifferenceRecord& one : all) {
    const bool isEqual = one.verdict == DifferenceVerdict::equal;
    const compare::Interval ends =
        isEqual ? compare::Interval{} : one.interval.value_or(compare::Interval{-1, 1});
    estimate.value += one.difference / count;
    estimate.uncertainty += one.uncertainty / count;
    estimate.interval->low += ends.low / count;
    estimate.interval->high += ends.high / count;
    estimate.areEqual = estimate.areEqual && isEqual;
  }
  DifferenceRecord mean = all.front();
  if (!estimate.areEqual) mean.reason.clear();
  if (unknown != all.end() && !isDistinguishable(estimate)) {
    estimate.interval.reset();
    mean.reason = unknown->reason;
  }
  mean.difference = estimate.value;
  mean.interval = estimate.areEqual ? std::nullopt : estimate.interval;
  mean.uncertainty = estimate.uncertainty;
  mean.verdict = distinguish(estimate);
  return mean;
}

std::vector<DifferenceRecord> differencesOverViews(const StudyRecord& record,
                                                   const std::vector<std::string>& labels) {
  std::map<std::string_view, std::size_t> places;
  for (std::size_t i = 0; i < labels.size(); ++i) places.emplace(labels[i], i);
  std::map<std::pair<std::size_t, std::size_t>, std::vector<DifferenceRecord>> views;
  for (const DifferenceRecord& row : record.differences) {
    const auto first = places.find(row.first);
    const auto second = places.find(row.second);
    if (row.light != allLights || first == places.end() || second == places.end()) continue;
    if (first->second < second->second) {
      views[{first->second, second->second}].push_back(row);
    } else {
      views[{second->second, first->second}].push_back(swapped(row));
    }
  }
  std::vector<DifferenceRecord> means;
  means.reserve(views.size());
  for (const auto& [pair, rows] : views) means.push_back(meanDifference(rows));
  return means;
}

std::optional<DifferenceRecord> differenceOverViews(const StudyRecord& record,
                                                    std::string_view first,
                                                    std::string_view second) {
  std::vector<DifferenceRecord> found =
      differencesOverViews(record, {std::string(first), std::string(second)});
  return found.empty() ? std::nullopt : std::optional(std::move(found.front()));
}

}  // namespace gnomon::study
