#include "compare/rates.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/error.h"

namespace gnomon::compare {
namespace {

/// A metric's value, or the reason why it has none.
struct Figure {
  std::optional<double> value;
  std::string_view reason;
};

Figure defined(double value) {
  return {value, {}};
}

Figure undefined(std::string_view reason) {
  return {std::nullopt, reason};
}

/// Why no metric at all is defined, or empty.
std::string_view emptiness(const Counts& c) {
  if (c.samples == 0) return "no samples";
  if (c.total() == 0) return "the samples have no area";
  return {};
}

Figure share(double part, const Counts& c) {
  const std::string_view reason = emptiness(c);
  return reason.empty() ? defined(part / c.total()) : undefined(reason);
}

Figure errorRate(const Counts& c) {
  return share(c.falsePositive + c.falseNegative, c);
}

Figure falseShadow(const Counts& c) {
  return share(c.falsePositive, c);
}

Figure falseLight(const Counts& c) {
  return share(c.falseNegative, c);
}

Figure prevalence(const Counts& c) {
  return share(c.truePositive + c.falseNegative, c);
}

/// part / whole, undefined for the given reason where the whole is empty.
Figure ratio(double part, double whole, const Counts& c, std::string_view reason) {
  if (whole > 0) return defined(part / whole);
  const std::string_view empty = emptiness(c);
  return undefined(empty.empty() ? reason : empty);
}

Figure fpr(const Counts& c) {
  return ratio(c.falsePositive, c.falsePositive + c.trueNegative, c, "the truth has no lit sample");
}

Figure fnr(const Counts& c) {
  return ratio(c.falseNegative, c.falseNegative + c.truePositive, c, "the truth has no shadow");
}

Figure ber(const Counts& c) {
  const Figure ofLit = fpr(c);
  const Figure ofShadow = fnr(c);
  if (!ofLit.value) return ofLit;
  if (!ofShadow.value) return ofShadow;
  return defined((*ofLit.value + *ofShadow.value) / 2);
}

constexpr std::string_view noShadow = "neither the truth nor the candidate has a shadow";

Figure iou(const Counts& c) {
  return ratio(c.truePositive, c.truePositive + c.falsePositive + c.falseNegative, c, noShadow);
}

Figure f1(const Counts& c) {
  // The mean of both masks' shadow: half the usual denominator, which could overflow.
  const double meanShadow = c.truePositive + (c.falsePositive + c.falseNegative) / 2;
  return ratio(c.truePositive, meanShadow, c, noShadow);
}

/// Exact for equal arguments, and free of the overflow and underflow of a product.
double geometricMean(double a, double b) {
  return a == b ? a : std::sqrt(a) * std::sqrt(b);
}

Figure mcc(const Counts& c) {
  const double candidateShadow = c.truePositive + c.falsePositive;
  const double truthShadow = c.truePositive + c.falseNegative;
  const double truthLit = c.trueNegative + c.falsePositive;
  const double candidateLit = c.trueNegative + c.falseNegative;
  const std::string_view empty = emptiness(c);
  if (!empty.empty()) return undefined(empty);
  if (truthLit == 0) return undefined("the truth has no lit sample");
  if (truthShadow == 0) return undefined("the truth has no shadow");
  if (candidateLit == 0) return undefined("the candidate has no lit sample");
  if (candidateShadow == 0) return undefined("the candidate has no shadow");
  // The usual quotient, split so that every factor lies between 0 and 1.
  const double agreement = c.truePositive / geometricMean(candidateShadow, truthShadow) *
                           (c.trueNegative / geometricMean(truthLit, candidateLit));
  const double disagreement = c.falsePositive / geometricMean(candidateShadow, truthLit) *
                              (c.falseNegative / geometricMean(truthShadow, candidateLit));
  return defined(std::clamp(agreement - disagreement, -1.0, 1.0));
}

struct Rate {
  MetricId id;
  Figure (*formula)(const Counts&);

  [[nodiscard]] Metric of(const Counts& counts) const {
    const auto [value, reason] = formula(counts);
    return {id, value, reason};
  }
};

constexpr std::array<Rate, 10> allRates = {{{"error_rate", errorRate},
                                            {"false_shadow", falseShadow},
                                            {"false_light", falseLight},
                                            {"fpr", fpr},
                                            {"fnr", fnr},
                                            {"ber", ber},
                                            {"iou", iou},
                                            {"f1", f1},
                                            {"mcc", mcc},
                                            {"prevalence", prevalence}}};

void requireSound(const Counts& c) {
  const std::array cells = {c.truePositive, c.falsePositive, c.falseNegative, c.trueNegative};
  const bool negative = std::any_of(cells.begin(), cells.end(), [](double x) { return !(x >= 0); });
  if (negative || !std::isfinite(c.total())) {
    throw InternalError(
        fmt::format("counts: tp {}, fp {}, fn {}, tn {}: finite cells of at least 0 expected",
                    cells[0], cells[1], cells[2], cells[3]));
  }
}

}  // namespace

std::vector<Metric> rates(const Counts& counts) {
  requireSound(counts);
  std::vector<Metric> metrics;
  metrics.reserve(allRates.size());
  for (const Rate& rate : allRates) metrics.push_back(rate.of(counts));
  return metrics;
}

Metric rate(const Counts& counts, MetricId id) {
  requireSound(counts);
  for (const Rate& rate : allRates) {
    if (rate.id == id) return rate.of(counts);
  }
  throw InternalError(fmt::format("metric: \"{}\" is not one that rates() has", id.name()));
}

}  // namespace gnomon::compare
