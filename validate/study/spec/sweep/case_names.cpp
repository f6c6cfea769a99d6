#include "study/spec/sweep/case_names.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <string>

namespace gnomon::study {
namespace {

constexpr std::size_t longestName = 64;

bool isLetterOrDigit(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0;
}

std::string lowered(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// Letters and digits, and one dash for whatever stands between them.
std::string plainText(const std::string& text) {
  std::string plain;
  for (const char c : text) {
    if (isLetterOrDigit(c)) {
      plain += c;
    } else if (!plain.empty() && plain.back() != '-') {
      plain += '-';
    }
  }
  if (!plain.empty() && plain.back() == '-') plain.pop_back();
  return plain;
}

std::string valueName(const SweptValue& value) {
  if (!value.number) return plainText(value.text);
  std::string name = value.text;
  std::erase(name, '+');
  return name;
}

std::string numbered(const char* name, std::size_t index, std::size_t count) {
  return fmt::format("{}-{:0{}}", name, index + 1, fmt::formatted_size("{}", count));
}

/// The parts of a case's name.
class CaseNamer {
 public:
  explicit CaseNamer(std::span<const SweptKey> keys) : keys_(keys), names_(shortNames(keys)) {}

  [[nodiscard]] std::string name(const SweepCase& which) const {
    std::string name;
    for (std::size_t k = 0; k < keys_.size(); ++k) {
      name += fmt::format("{}{}-{}", name.empty() ? "" : "_", plainText(names_[k]),
                          valueName(which.values.at(k)));
    }
    return name;
  }

 private:
  std::span<const SweptKey> keys_;
  std::vector<std::string> names_;
};

bool areGood(std::span<const SweepCase> cases) {
  std::set<std::string> seen;
  return std::all_of(cases.begin(), cases.end(), [&](const SweepCase& which) {
    return which.name.size() <= longestName && seen.insert(lowered(which.name)).second;
  });
}

}  // namespace

void nameCases(std::span<const SweptKey> keys, std::vector<SweepCase>& cases) {
  const bool areNumbers = std::all_of(cases.begin(), cases.end(), [](const SweepCase& which) {
    return which.values.front().number.has_value();
  });
  if (keys.size() == 1 && areNumbers) {
    for (SweepCase& which : cases) which.name = which.values.front().text;
    return;
  }
  const CaseNamer names(keys);
  for (SweepCase& which : cases) which.name = names.name(which);
  if (areGood(cases)) return;
  for (std::size_t c = 0; c < cases.size(); ++c) {
    cases[c].name = numbered("case", c, cases.size());
  }
}

}  // namespace gnomon::study
