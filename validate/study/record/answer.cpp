#include "study/record/answer.h"

namespace gnomon::study {

std::string_view answerName(Answer answer) {
  return answer == Answer::drawn ? "drawn" : "test";
}

std::optional<Answer> answerOfName(std::string_view name) {
  for (const Answer answer : allAnswers) {
    if (answerName(answer) == name) return answer;
  }
  return std::nullopt;
}

}  // namespace gnomon::study
