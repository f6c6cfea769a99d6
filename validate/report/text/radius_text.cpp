#include "report/text/radius_text.h"

#include <fmt/core.h>

#include "report/text/names.h"

namespace gnomon::report {
namespace {

std::string_view nameOf(study::Verdict verdict) {
  return study::verdictName(verdict);
}

std::string_view nameOf(study::DifferenceVerdict verdict) {
  return differenceVerdictName(verdict);
}

template <typename Row>
std::string noteOf(const Row& row) {
  if (!row.radius || !row.radius->turns(row.verdict)) return "";
  return fmt::format("depends on the radius: {} at half of it, {} at twice",
                     nameOf(row.radius->atHalf), nameOf(row.radius->atTwice));
}

}  // namespace

std::string radiusNote(const study::ClaimRecord& claim) {
  return noteOf(claim);
}

std::string radiusNote(const study::DifferenceRecord& difference) {
  return noteOf(difference);
}

}  // namespace gnomon::report
