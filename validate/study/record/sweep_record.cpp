#include "study/record/sweep_record.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <map>

namespace gnomon::study {

SweptValue sweptNumber(double number) {
  const std::string text = fmt::format("{}", number);
  return {text, number, text};
}

std::size_t dimensionCount(std::span<const SweptKey> keys) {
  std::size_t count = 0;
  for (const SweptKey& key : keys) count = std::max(count, key.dimension + 1);
  return count;
}

std::string caseText(std::span<const SweptKey> keys, const SweepCase& which) {
  std::string text;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    text += fmt::format("{}{} = {}", k == 0 ? "" : ", ", keys[k].key, which.values.at(k).text);
  }
  return text;
}

std::vector<std::string> shortNames(std::span<const SweptKey> keys) {
  const auto lastPart = [](const SweptKey& key) { return key.key.substr(key.key.rfind('.') + 1); };
  const auto lowered = [](std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
  };
  std::vector<std::string> names;
  for (const SweptKey& key : keys) {
    const auto alike = std::count_if(keys.begin(), keys.end(), [&](const SweptKey& other) {
      return lowered(lastPart(other)) == lowered(lastPart(key));
    });
    names.push_back(alike > 1 ? key.key : lastPart(key));
  }
  return names;
}

std::string keysText(std::span<const SweptKey> keys) {
  std::string text;
  for (const SweptKey& key : keys) text += (text.empty() ? "" : ", ") + key.key;
  return text;
}

RunStatus SweepRecord::status() const {
  std::vector<Judgement> judgements;
  std::vector<ProblemRecord> problems;
  for (const StudyRecord& step : steps) {
    judgements.insert(judgements.end(), step.judgements.begin(), step.judgements.end());
    problems.insert(problems.end(), step.problems.begin(), step.problems.end());
  }
  return runStatus(judgements, problems);
}

std::vector<std::string> SweepRecord::notices() const {
  std::vector<std::string> texts;
  std::map<std::string, std::vector<std::size_t>> casesOf;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    for (const std::string& text : steps[i].notices) {
      std::vector<std::size_t>& at = casesOf[text];
      if (at.empty()) texts.push_back(text);
      at.push_back(i);
    }
  }
  for (std::string& text : texts) {
    const std::vector<std::size_t>& at = casesOf[text];
    if (at.size() < steps.size()) {
      text = fmt::format("At {}{}: {}", keys.size() == 1 ? keys.front().key + " = " : "",
                         casesText(at), text);
    }
  }
  return texts;
}

std::string SweepRecord::casesText(const std::vector<std::size_t>& which) const {
  constexpr std::size_t most = 12;
  std::vector<std::string> texts;
  for (const std::size_t i : std::span(which).first(std::min(which.size(), most))) {
    texts.push_back(keys.size() == 1 ? cases.at(i).values.front().text : cases.at(i).name);
  }
  const std::string more =
      which.size() > most ? fmt::format(" and {} more", which.size() - most) : "";
  return fmt::format("{}{}", fmt::join(texts, ", "), more);
}

}  // namespace gnomon::study
