#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace gnomon::study {

/// Which of a method's two answers a figure is of (`MethodAnswers`): `drawn` is the score.
enum class Answer { drawn, test };

/// Both, the score first.
constexpr std::array<Answer, 2> allAnswers = {Answer::drawn, Answer::test};

/// "drawn", "test".
std::string_view answerName(Answer answer);
/// The answer of a name; none for another text.
std::optional<Answer> answerOfName(std::string_view name);

}  // namespace gnomon::study
