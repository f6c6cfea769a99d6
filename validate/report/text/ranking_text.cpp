#include "report/text/ranking_text.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "common/lists.h"
#include "report/text/number_text.h"

namespace gnomon::report {

std::string fewerCasesText(std::size_t cases, std::size_t allCases, const std::string& best,
                           std::optional<double> leaderError) {
  std::string text = fmt::format("in {} of {} cases: no rank", cases, allCases);
  if (!leaderError) return text;
  return fmt::format("{}; {} has {} % on the same", text, best, percentText(leaderError));
}

std::string quotedText(const std::string& label) {
  return "“" + label + "”";
}

std::string listText(const std::vector<std::string>& labels) {
  constexpr std::size_t most = 3;
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < std::min(most, labels.size()); ++i) {
    parts.push_back(quotedText(labels[i]));
  }
  if (labels.size() > most) parts.push_back(fmt::format("{} more", labels.size() - most));
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) text += i + 1 == parts.size() ? " and " : ", ";
    text += parts[i];
  }
  return text;
}

std::string_view differenceSign(study::DifferenceVerdict verdict) {
  switch (verdict) {
    case study::DifferenceVerdict::equal:
      return " =";
    case study::DifferenceVerdict::notDistinguishable:
      return " ≈";
    case study::DifferenceVerdict::noInterval:
      return " ?";
    default:
      return "";
  }
}

std::string likeText(const study::LikeMethods& methods) {
  std::vector<std::string> parts;
  const auto add = [&](const char* what, const std::vector<std::string>& labels) {
    if (!labels.empty()) parts.push_back(what + listText(labels));
  };
  add("the same answers as ", methods.equal);
  add("not distinguishable from ", methods.close);
  add("no interval of the difference from ", methods.withoutInterval);
  return fmt::format("{}", fmt::join(parts, "; "));
}

std::vector<std::string> noIntervalNotes(const std::vector<study::DifferenceRecord>& toBest) {
  std::vector<std::pair<std::string, std::vector<std::string>>> byReason;
  for (const study::DifferenceRecord& difference : toBest) {
    if (difference.verdict != study::DifferenceVerdict::noInterval) continue;
    auto found = std::find_if(byReason.begin(), byReason.end(), [&](const auto& reason) {
      return reason.first == difference.reason;
    });
    if (found == byReason.end()) found = byReason.insert(found, {difference.reason, {}});
    appendOnce(found->second, difference.first);
  }
  std::vector<std::string> notes;
  for (const auto& [reason, labels] : byReason) {
    notes.push_back(
        fmt::format("? No interval of the difference of {}: {}.", listText(labels), reason));
  }
  return notes;
}

}  // namespace gnomon::report
