#include "report/text/ranking_text.h"

#include <fmt/core.h>

#include <algorithm>

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

std::string indistinguishableText(const LikeMethods& methods) {
  std::string text;
  if (!methods.close.empty()) text = "not distinguishable from " + listText(methods.close);
  if (methods.withoutInterval.empty()) return text;
  return fmt::format("{}{}could not be compared with {}: no 95 % interval", text,
                     text.empty() ? "" : "; ", listText(methods.withoutInterval));
}

}  // namespace gnomon::report
