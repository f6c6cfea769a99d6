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
  CaseNamer(std::span<const SweptKey> keys, std::span<const std::vector<std::size_t>> places)
      : keys_(keys), names_(shortNames(keys)), draws_(dimensionCount(keys), 0) {
    for (const std::vector<std::size_t>& place : places) {
      for (std::size_t d = 0; d < place.size(); ++d) draws_[d] = std::max(draws_[d], place[d] + 1);
    }
  }

  [[nodiscard]] std::string name(const SweepCase& which,
                                 const std::vector<std::size_t>& place) const {
    std::string name;
    bool isDrawn = false;
    for (std::size_t k = 0; k < keys_.size(); ++k) {
      if (keys_[k].isDrawn && isDrawn) continue;
      isDrawn |= keys_[k].isDrawn;
      const std::size_t d = keys_[k].dimension;
      name += name.empty() ? "" : "_";
      name += keys_[k].isDrawn
                  ? numbered("draw", place[d], draws_[d])
                  : fmt::format("{}-{}", plainText(names_[k]), valueName(which.values.at(k)));
    }
    return name;
  }

 private:
  std::span<const SweptKey> keys_;
  std::vector<std::string> names_;
  std::vector<std::size_t> draws_;  ///< the steps of each dimension
};

bool areGood(std::span<const SweepCase> cases) {
  std::set<std::string> seen;
  return std::all_of(cases.begin(), cases.end(), [&](const SweepCase& which) {
    return which.name.size() <= longestName && seen.insert(lowered(which.name)).second;
  });
}

}  // namespace

void nameCases(std::span<const SweptKey> keys, std::span<const std::vector<std::size_t>> places,
               std::vector<SweepCase>& cases) {
  const bool areNumbers = std::all_of(cases.begin(), cases.end(), [](const SweepCase& which) {
    return which.values.front().number.has_value();
  });
  if (keys.size() == 1 && !keys.front().isDrawn && areNumbers) {
    for (SweepCase& which : cases) which.name = which.values.front().text;
    return;
  }
  const CaseNamer names(keys, places);
  for (std::size_t c = 0; c < cases.size(); ++c) cases[c].name = names.name(cases[c], places[c]);
  if (areGood(cases)) return;
  for (std::size_t c = 0; c < cases.size(); ++c) {
    cases[c].name = numbered("case", c, cases.size());
  }
}

}  // namespace gnomon::study
