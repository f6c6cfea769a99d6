#include "report/text/ranking_text.h"

#include <fmt/core.h>

#include <algorithm>

#include "report/text/number_text.h"

namespace gnomon::report {

std::string fewerCasesText(std::size_t cases, std::size_t allCases, const std::string& best,
                           std::optional<double> leaderError) {
  const std::string text = fmt::format("in {} of {} cases: no rank", cases, allCases);
  if (!leaderError) return text;
  return fmt::format("{}; {} has {} % on the same", text, best, percentText(leaderError));
}

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

std::string indistinguishableText(const std::vector<std::string>& names) {
  return names.empty() ? "" : "not distinguishable from " + listText(names);
}

}  // namespace gnomon::report
