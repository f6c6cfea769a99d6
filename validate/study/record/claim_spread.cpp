#include "study/record/claim_spread.h"

#include <fmt/core.h>

#include <algorithm>

#include "common/error.h"
#include "common/quantile.h"

namespace gnomon::study {
namespace {

std::string quartilesText(const ClaimSpread& spread) {
  if (!spread.quartiles) return "";
  const Quartiles& q = *spread.quartiles;
  std::string text = fmt::format("; {} {:.2f}", spread.quantity, q.median);
  if (spread.cases < 2) return text;
  text += fmt::format(" ({:.2f} to {:.2f}", q.least, q.most);
  if (spread.cases >= 4) text += fmt::format(", quartiles {:.2f} and {:.2f}", q.first, q.third);
  return text + ")";
}

/// "holds for all lights together; ", where that was judged.
std::string togetherText(const ClaimSpread& spread, const char* unit) {
  if (!spread.together) return "";
  const std::string_view verdict = *spread.together == Verdict::held ? "holds"
                                   : *spread.together == Verdict::failed
                                       ? "fails"
                                       : verdictName(*spread.together);
  return fmt::format("{} for all {}s together; ", verdict, unit);
}

}  // namespace

std::string_view verdictName(Verdict verdict) {
  switch (verdict) {
    case Verdict::held:
      return "held";
    case Verdict::failed:
      return "failed";
    case Verdict::equal:
      return "equal";
    case Verdict::notDistinguishable:
      return "not distinguishable";
    case Verdict::noInterval:
      return "no interval";
    case Verdict::notEvaluated:
      return "not evaluated";
  }
  throw InternalError("verdict: not one of its six values");
}

std::optional<Quartiles> quartilesOf(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  return Quartiles{values.front(), quantile(values, 0.25), quantile(values, 0.5),
                   quantile(values, 0.75), values.back()};
}

std::string spreadText(const ClaimSpread& spread) {
  const bool ofLights = spread.views == 1;
  const char* where = ofLights ? "under" : "in";
  const char* unit = ofLights ? "light" : "case";
  const auto some = [&](Verdict verdict, std::size_t count) {
    return count == 0 ? "" : fmt::format(", {} {} {}", verdictName(verdict), where, count);
  };
  return fmt::format("{}holds {} {} of {} {}{}, fails {} {}{}{}{}", togetherText(spread, unit),
                     where, spread.held, spread.cases, unit, spread.cases == 1 ? "" : "s", where,
                     spread.failed, some(Verdict::equal, spread.equal),
                     some(Verdict::noInterval, spread.withoutInterval), quartilesText(spread));
}

}  // namespace gnomon::study
