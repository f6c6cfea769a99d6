#include "study/record/sweep_record.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <span>

namespace gnomon::study {

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
