#include "render/passes/soft_answer.h"

#include <fmt/core.h>

#include "common/error.h"

namespace gnomon::render {

std::optional<std::string> softDefine(const Method& method, SoftAnswer soft) {
  const bool isDisc = soft == SoftAnswer::disc;
  if (isDisc && !method.hasHorizon) {
    throw InputError(fmt::format(
        "method {}: no function `float horizonSlope(Pixel pixel, LocalLight light)` in {}, which "
        "the light's disc could be held against",
        method.name, method.source.file));
  }
  if (!isDisc && !method.answersShares) return std::nullopt;
  return isDisc ? "ANSWER_DISC" : "ANSWER_SHARE";
}

}  // namespace gnomon::render
