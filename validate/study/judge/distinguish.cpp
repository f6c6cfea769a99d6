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
    case DifferenceVerdict::notDistinguishable:
      break;
  }
  return verdict;
}

DifferenceVerdict distinguish(const Estimate& estimate, double number) {
  const double distance = estimate.value - number;
  if (!estimate.interval || estimate.interval->holds(number) ||
      !(std::abs(distance) > estimate.uncertainty)) {
    return DifferenceVerdict::notDistinguishable;
  }
  return distance < 0 ? DifferenceVerdict::better : DifferenceVerdict::worse;
}

bool isDistinguishable(const Estimate& estimate, double number) {
  return distinguish(estimate, number) != DifferenceVerdict::notDistinguishable;
}

Estimate estimateOf(const DifferenceRecord& difference) {
  return {difference.difference, difference.interval, difference.uncertainty};
}

DifferenceRecord swapped(DifferenceRecord difference) {
  std::swap(difference.first, difference.second);
  difference.difference = -difference.difference;
  if (difference.interval) {
    difference.interval = compare::Interval{-difference.interval->high, -difference.interval->low};
  }
  difference.verdict = opposite(difference.verdict);
  if (difference.radius) {
    difference.radius = {opposite(difference.radius->atHalf), opposite(difference.radius->atTwice)};
  }
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
  DifferenceRecord mean = all.front();
  compare::Interval ends;
  mean.difference = 0;
  mean.uncertainty = 0;
  for (const DifferenceRecord& one : all) {
    mean.difference += one.difference / count;
    mean.uncertainty += one.uncertainty / count;
    if (!one.interval) {
      mean.interval.reset();
      mean.reason = one.reason;
      continue;
    }
    ends = {ends.low + one.interval->low / count, ends.high + one.interval->high / count};
  }
  if (mean.interval) mean.interval = ends;
  mean.verdict = distinguish(estimateOf(mean));
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
