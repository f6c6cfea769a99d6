#include "report/text/ranking_text.h"

#include <fmt/core.h>

#include "report/text/number_text.h"

namespace gnomon {

std::string fewerCasesText(std::size_t cases, std::size_t allCases, const std::string& best,
                           std::optional<double> leaderError) {
  const std::string text = fmt::format("in {} of {} cases: no rank", cases, allCases);
  if (!leaderError) return text;
  return fmt::format("{}; {} has {} % on the same", text, best, percentText(leaderError));
}

}  // namespace gnomon
