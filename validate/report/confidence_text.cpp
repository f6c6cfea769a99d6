#include "report/confidence_text.h"

#include <fmt/core.h>

#include <algorithm>

#include "report/budget_text.h"
#include "report/interval_text.h"
#include "report/number_text.h"
#include "report/radius_text.h"
#include "study/distinguish.h"

namespace gnomon {
namespace {

/// "a", "a and b", "a; b; c and 2 more": labels may hold commas.
std::string listText(const std::vector<std::string>& names) {
  constexpr std::size_t most = 3;
  std::vector<std::string> parts(
      names.begin(), names.begin() + static_cast<std::ptrdiff_t>(std::min(most, names.size())));
  if (names.size() > most) parts.push_back(fmt::format("{} more", names.size() - most));
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) text += i + 1 == parts.size() ? " and " : "; ";
    text += parts[i];
  }
  return text;
}

/// @param difference  of the worse method, less the best
std::string betterText(const DifferenceRecord& difference) {
  // It says what becomes of the best.
  const std::string radius = radiusNote(swapped(difference));
  return fmt::format("{} is better than {} by {} % of the samples ({}){}.", difference.second,
                     difference.first, percentText(difference.difference),
                     intervalText(difference.interval), radius.empty() ? "" : ", which " + radius);
}

}  // namespace

std::vector<std::string> confidenceViews(const StudyRecord& record) {
  std::vector<std::string> views;
  for (const ConfidenceRecord& row : record.confidence) {
    if (std::find(views.begin(), views.end(), row.view) == views.end()) views.push_back(row.view);
  }
  return views;
}

std::vector<ConfidenceRecord> rankedIn(const StudyRecord& record, const std::string& view) {
  std::vector<ConfidenceRecord> ranked;
  for (const ConfidenceRecord& row : record.confidence) {
    if (row.view == view && row.light == allLights) ranked.push_back(row);
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& a, const auto& b) { return a.rate < b.rate; });
  return ranked;
}

std::string verdictText(const StudyRecord& record, const std::string& view) {
  const std::vector<ConfidenceRecord> ranked = rankedIn(record, view);
  if (ranked.size() < 2) return "";
  const std::string& best = ranked.front().method;
  std::string better;
  std::vector<std::string> alike;
  for (std::size_t i = 1; i < ranked.size(); ++i) {
    const auto difference = differenceOf(record, view, allLights, ranked[i].method, best);
    if (!difference) continue;
    if (difference->verdict == DifferenceVerdict::notDistinguishable) {
      alike.push_back(ranked[i].method);
    } else if (better.empty()) {
      better = betterText(*difference);
    }
  }
  if (alike.empty()) return better;
  const std::string same = fmt::format("{} is not distinguishable from {}.", best, listText(alike));
  return better.empty() ? same : better + " " + same;
}

std::string differenceMark(const DifferenceRecord& toBest) {
  const bool isAlike = toBest.verdict == DifferenceVerdict::notDistinguishable;
  if (radiusNote(toBest).empty()) return isAlike ? " ≈" : "";
  return (isAlike ? "≈" : " ") + std::string(radiusMark);
}

std::string confidenceNote(const StudyRecord& record, const std::string& view) {
  const std::vector<ConfidenceRecord> ranked = rankedIn(record, view);
  if (ranked.empty()) return "";
  std::string truth;
  std::string radius;
  for (const DifferenceRecord& row : record.differences) {
    if (row.view == view && row.light == allLights) {
      if (row.radius) {
        radius = fmt::format(
            " {} depends on the radius: another verdict at half or at twice of it.", radiusMark);
      }
      truth = fmt::format(", or it is within the truth’s uncertainty of {} %",
                          percentText(row.uncertainty));
    }
  }
  return fmt::format(
      "Percent of the samples, mean over the lights. {} It is told from {} blocks of {} × {} "
      "samples. ≈ not distinguishable from the best: the interval of the difference holds 0, there "
      "is none{}.{}",
      intervalMeaning, ranked.front().blocks, ranked.front().blockSide, ranked.front().blockSide,
      truth, radius);
}

}  // namespace gnomon
