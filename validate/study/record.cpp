#include "study/record.h"

#include <algorithm>

namespace gnomon {

std::string_view answerName(Answer answer) {
  return answer == Answer::drawn ? "drawn" : "test";
}

std::optional<Answer> answerOfName(std::string_view name) {
  for (const Answer answer : allAnswers) {
    if (answerName(answer) == name) return answer;
  }
  return std::nullopt;
}

bool StudyRecord::passed() const {
  return std::all_of(thresholds.begin(), thresholds.end(),
                     [](const ThresholdRecord& threshold) { return threshold.passed; });
}

}  // namespace gnomon
