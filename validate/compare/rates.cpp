#include "compare/rates.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/error.h"

namespace gnomon::compare {
namespace {

Metric defined(double value) {
  return {{}, value, {}};
}

Metric undefined(std::string_view reason) {
  return {{}, std::nullopt, reason};
}

/// Why no metric at all is defined, or empty.
std::string_view emptiness(const Counts& c) {
  if (c.samples == 0) return "no samples";
  if (c.total() == 0) return "the samples have no area";
  return {};
}

Metric share(double part, const Counts& c) {
  const std::string_view reason = emptiness(c);
  return reason.empty() ? defined(part / c.total()) : undefined(reason);
}

Metric errorRate(const Counts& c) {
  return share(c.falsePositive + c.falseNegative, c);
}

Metric falseShadow(const Counts& c) {
  return share(c.falsePositive, c);
}

Metric falseLight(const Counts& c) {
  return share(c.falseNegative, c);
}

Metric prevalence(const Counts& c) {
  return share(c.truePositive + c.falseNegative, c);
}

/// part / whole, undefined for the given reason where the whole is empty.
Metric ratio(double part, double whole, const Counts& c, std::string_view reason) {
  if (whole > 0) return defined(part / whole);
  const std::string_view empty = emptiness(c);
  return undefined(empty.empty() ? reason : empty);
}

Metric fpr(const Counts& c) {
  return ratio(c.falsePositive, c.falsePositive + c.trueNegative, c, "the truth has no lit sample");
}

Metric fnr(const Counts& c) {
  return ratio(c.falseNegative, c.falseNegative + c.truePositive, c, "the truth has no shadow");
}

Metric ber(const Counts& c) {
  const Metric ofLit = fpr(c);
  const Metric ofShadow = fnr(c);
  if (!ofLit.value) return ofLit;
  if (!ofShadow.value) return ofShadow;
  return defined((*ofLit.value + *ofShadow.value) / 2);
}

constexpr std::string_view noShadow = "neither the truth nor the candidate has a shadow";

Metric iou(const Counts& c) {
  return ratio(c.truePositive, c.truePositive + c.falsePositive + c.falseNegative, c, noShadow);
}

Metric f1(const Counts& c) {
  // The mean of both masks' shadow: half the usual denominator, which could overflow.
  const double meanShadow = c.truePositive + (c.falsePositive + c.falseNegative) / 2;
  return ratio(c.truePositive, meanShadow, c, noShadow);
}

/// Exact for equal arguments, and free of the overflow and underflow of a product.
double geometricMean(double a, double b) {
  return a == b ? a : std::sqrt(a) * std::sqrt(b);
}

Metric mcc(const Counts& c) {
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

struct NamedRate {
  std::string_view name;
  Metric (*compute)(const Counts&);
  double least = 0;
};

constexpr std::array<NamedRate, 10> allRates = {{{"error_rate", errorRate},
                                                 {"false_shadow", falseShadow},
                                                 {"false_light", falseLight},
                                                 {"fpr", fpr},
                                                 {"fnr", fnr},
                                                 {"ber", ber},
                                                 {"iou", iou},
                                                 {"f1", f1},
                                                 {"mcc", mcc, -1},
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

Metric evaluate(const NamedRate& rate, const Counts& counts) {
  Metric metric = rate.compute(counts);
  metric.name = rate.name;
  return metric;
}

}  // namespace

std::vector<Metric> rates(const Counts& counts) {
  requireSound(counts);
  std::vector<Metric> metrics;
  metrics.reserve(allRates.size());
  for (const NamedRate& rate : allRates) metrics.push_back(evaluate(rate, counts));
  return metrics;
}

Metric rate(const Counts& counts, std::string_view name) {
  requireSound(counts);
  for (const NamedRate& rate : allRates) {
    if (rate.name == name) return evaluate(rate, counts);
  }
  throw InternalError(fmt::format("metric: \"{}\" is not one that rates() has", name));
}

double leastRate(std::string_view name) {
  const auto* found = std::find_if(allRates.begin(), allRates.end(),
                                   [&](const NamedRate& rate) { return rate.name == name; });
  return found == allRates.end() ? 0 : found->least;
}

const Metric& metricNamed(std::span<const Metric> metrics, std::string_view name) {
  const auto found = std::find_if(metrics.begin(), metrics.end(),
                                  [&](const Metric& metric) { return metric.name == name; });
  if (found == metrics.end()) {
    throw InternalError(fmt::format("metric \"{}\" found, a measured one expected", name));
  }
  return *found;
}

const std::vector<std::string_view>& rateNames() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> list;
    list.reserve(std::size(allRates));
    for (const NamedRate& rate : allRates) list.push_back(rate.name);
    return list;
  }();
  return names;
}

}  // namespace gnomon::compare
