#include "study/record/sweep_record.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <map>

namespace gnomon {

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
  std::map<std::string, std::vector<std::string>> valuesOf;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    for (const std::string& text : steps[i].notices) {
      std::vector<std::string>& at = valuesOf[text];
      if (at.empty()) texts.push_back(text);
      at.push_back(sweepValueText(values.at(i)));
    }
  }
  for (std::string& text : texts) {
    const std::vector<std::string>& at = valuesOf[text];
    if (at.size() < steps.size()) {
      text = fmt::format("At {} = {}: {}", key, fmt::join(at, ", "), text);
    }
  }
  return texts;
}

std::string sweepValueText(double value) {
  return fmt::format("{}", value);
}

}  // namespace gnomon
