#include "report/text/confidence_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>

#include "common/lists.h"
#include "report/text/budget_text.h"
#include "report/text/interval_text.h"
#include "report/text/number_text.h"
#include "report/text/ranking_text.h"
#include "study/judge/distinguish.h"
#include "study/judge/study_means.h"

namespace gnomon::report {
namespace {

/// What several rows say of one figure: "0.30", or "0.30 to 0.55" where they differ.
class Range {
 public:
  void add(double value) {
    low_ = std::min(low_, value);
    high_ = std::max(high_, value);
  }
  [[nodiscard]] bool isEmpty() const { return low_ > high_; }
  template <typename Text>
  [[nodiscard]] std::string text(const Text& textOf) const {
    const std::string low = textOf(low_);
    const std::string high = textOf(high_);
    return low == high ? low : low + " to " + high;
  }

 private:
  double low_ = std::numeric_limits<double>::infinity();
  double high_ = -std::numeric_limits<double>::infinity();
};

/// @param difference  of the worse method, less the best
/// @param whole  what it is a share of (errorWhole)
std::string betterText(const study::DifferenceRecord& difference, const char* whole) {
  return fmt::format("{} is better than {} by {} % of {} (95 % interval {}).",
                     quotedText(difference.second), quotedText(difference.first),
                     percentText(difference.difference), whole, intervalText(difference.interval));
}

}  // namespace

std::vector<std::string> confidenceViews(const study::StudyRecord& record) {
  std::vector<std::string> views;
  for (const study::ConfidenceRecord& row : record.confidence) appendOnce(views, row.view);
  return views;
}

std::vector<study::ConfidenceRecord> rankedIn(const study::StudyRecord& record,
                                              const std::string& view) {
  std::vector<study::ConfidenceRecord> ranked;
  for (const study::ConfidenceRecord& row : record.confidence) {
    if (row.view == view && row.light == study::allLights) ranked.push_back(row);
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& a, const auto& b) { return a.rate < b.rate; });
  return ranked;
}

std::string verdictText(const study::StudyRecord& record, const std::string& view) {
  const std::vector<study::ConfidenceRecord> ranked = rankedIn(record, view);
  if (ranked.size() < 2) return "";
  const std::string& best = ranked.front().method;
  std::string better;
  study::LikeMethods like;
  for (const study::DifferenceRecord& difference : differencesToBest(record, view)) {
    like.add(difference.first, difference.verdict);
    if (better.empty() && study::isDistinguishable(difference.verdict)) {
      better = betterText(difference, errorWhole(study::isSoft(record)));
    }
  }
  std::string text = better;
  const auto add = [&](const std::string& sentence) {
    text += (text.empty() ? "" : " ") + sentence;
  };
  const std::string name = quotedText(best);
  if (!like.equal.empty()) {
    add(fmt::format("{} gives the same answers as {}.", name, listText(like.equal)));
  }
  if (!like.close.empty()) {
    add(fmt::format("{} is not distinguishable from {}.", name, listText(like.close)));
  }
  if (!like.withoutInterval.empty()) {
    add(fmt::format("{} could not be compared with {}: the difference has no 95 % interval.", name,
                    listText(like.withoutInterval)));
  }
  return text;
}

std::vector<study::DifferenceRecord> differencesToBest(const study::StudyRecord& record,
                                                       const std::string& view) {
  const std::vector<study::ConfidenceRecord> ranked = rankedIn(record, view);
  std::vector<study::DifferenceRecord> found;
  for (const study::ConfidenceRecord& row : ranked) {
    const auto toBest =
        study::differenceOf(record, view, study::allLights, row.method, ranked.front().method);
    if (toBest) found.push_back(*toBest);
  }
  return found;
}

std::string confidenceNote(const study::StudyRecord& record, const std::string& view) {
  const std::vector<study::ConfidenceRecord> ranked = rankedIn(record, view);
  if (ranked.empty()) return "";
  Range blocks;
  for (const study::ConfidenceRecord& row : ranked) blocks.add(static_cast<double>(row.blocks));
  Range uncertainty;
  for (const study::DifferenceRecord& toBest : differencesToBest(record, view)) {
    uncertainty.add(toBest.uncertainty);
  }
  const std::string truth =
      uncertainty.isEmpty()
          ? ""
          : fmt::format(" The truth’s uncertainty is {} %.",
                        uncertainty.text([](double share) { return percentText(share); }));
  return fmt::format(
      "Percent of {}, mean over the lights. {} It comes from {} blocks of {} × {} "
      "samples. Compared with the best: {}.{}",
      errorWhole(study::isSoft(record)), intervalMeaning,
      blocks.text([](double count) { return fmt::format("{}", count); }), ranked.front().blockSide,
      ranked.front().blockSide, signMeaning, truth);
}

}  // namespace gnomon::report
