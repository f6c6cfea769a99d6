#include "compare/metric.h"

#include <fmt/core.h>

#include <charconv>
#include <system_error>

#include "common/error.h"
#include "compare/counts.h"
#include "compare/shadow_length.h"

namespace gnomon::compare {

MetricId MetricId::of(std::string_view name) {
  if (const auto found = find(name)) return *found;
  throw InternalError(fmt::format("metric \"{}\" found, one of the table expected", name));
}

const std::vector<MetricId>& allMetrics() {
  static const std::vector<MetricId> all = [] {
    std::vector<MetricId> list;
    for (std::size_t place = 0; place < metricTraits.size(); ++place) {
      list.push_back(MetricId(place));
    }
    return list;
  }();
  return all;
}

std::vector<MetricId> metricsOfKinds(std::initializer_list<MetricKind> kinds) {
  std::vector<MetricId> list = allMetrics();
  std::erase_if(list, [&](MetricId id) {
    return std::find(kinds.begin(), kinds.end(), id.kind()) == kinds.end();
  });
  return list;
}

std::vector<std::string> namesOf(std::span<const MetricId> metrics) {
  std::vector<std::string> names;
  for (const MetricId id : metrics) names.emplace_back(id.name());
  return names;
}

const Metric& metricNamed(std::span<const Metric> metrics, MetricId id) {
  const auto found = std::find_if(metrics.begin(), metrics.end(),
                                  [&](const Metric& metric) { return metric.id == id; });
  if (found == metrics.end()) {
    throw InternalError(fmt::format("metric \"{}\" found, a measured one expected", id.name()));
  }
  return *found;
}

namespace {

/// Whether a rate has one and the same value for several comparisons.
bool isSameForAll(MetricId metric, std::initializer_list<Counts> all) {
  if (metric.kind() != MetricKind::rate) return false;
  const auto first = rate(*all.begin(), metric).value;
  return first && std::all_of(all.begin(), all.end(), [&](const Counts& counts) {
           return rate(counts, metric).value == first;
         });
}

std::string_view withoutEndingSpaces(std::string_view text) {
  return text.substr(0, text.find_last_not_of(' ') + 1);
}

std::optional<double> numberOf(std::string_view text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, value);
  if (parsed.ec != std::errc() || parsed.ptr != end) return std::nullopt;
  return value;
}

/// "5 %" as "5e-2": divided by 100 it could be another double than 0.05 is.
std::optional<double> percentOf(std::string_view text) {
  const std::string_view digits = withoutEndingSpaces(text.substr(0, text.size() - 1));
  if (digits.empty() || digits.find_first_not_of("0123456789.-") != digits.npos)
    return std::nullopt;
  return numberOf(std::string(digits) + "e-2");
}

/// What a number that is no share of 1 may have meant.
std::string hint(MetricId metric, const MetricRange& range) {
  if (!range.isShare) return "";
  return fmt::format("; {} is a share: 0.05, or \"5 %\"", metric.name());
}

}  // namespace

MetricRange metricRange(MetricId metric, const PictureExtent& picture) {
  switch (metric.unit()) {
    case MetricUnit::share:
      return {};
    case MetricUnit::correlation:
      return {-1, 1, false};
    case MetricUnit::distance:
      return {0, picture.diagonal, false};
    case MetricUnit::ratio:
      return {0, picture.diagonal / static_cast<double>(leastRunSamples), false};
    case MetricUnit::count:
      return {0, picture.samples, false};
  }
  return {};
}

bool isOfTruthAlone(MetricId metric) {
  // The same truth, half of it shadowed, and candidates that are equal to it, differ by halves, and
  // differ everywhere.
  return metric.unit() == MetricUnit::count ||
         isSameForAll(metric, {{2, 0, 0, 2, 4}, {1, 1, 1, 1, 4}, {0, 2, 2, 0, 4}});
}

bool isSettledByLight(MetricId metric) {
  return isSameForAll(metric, {{0, 1, 0, 3, 4}, {0, 2, 0, 2, 4}, {0, 3, 0, 1, 4}});
}

bool isSettledByShadow(MetricId metric) {
  return isSameForAll(metric, {{1, 0, 3, 0, 4}, {2, 0, 2, 0, 4}, {3, 0, 1, 0, 4}});
}

std::optional<double> limitOfText(std::string_view text, const MetricRange& range) {
  if (text.ends_with('%')) return range.isShare ? percentOf(text) : std::nullopt;
  return numberOf(text);
}

void requireInRange(double limit, MetricId metric, const MetricRange& range) {
  if (limit >= range.least && limit <= range.most) return;
  throw InputError(fmt::format("{} found, {:.6g} to {:.6g} expected{}", limit, range.least,
                               range.most, hint(metric, range)));
}

void requireMissable(std::optional<double> minimum, std::optional<double> maximum, MetricId metric,
                     const MetricRange& range) {
  if (minimum && maximum && !(*minimum <= *maximum)) {
    throw InputError(
        fmt::format("`min` = {} found, at most `max` = {} expected", *minimum, *maximum));
  }
  if ((maximum && *maximum < range.most) || (minimum && *minimum > range.least)) return;
  throw InputError(fmt::format("{} found, which no {} can miss: {} {:.6g} expected{}",
                               maximum.value_or(minimum.value_or(range.least)), metric.name(),
                               maximum ? "below" : "above", maximum ? range.most : range.least,
                               hint(metric, range)));
}

}  // namespace gnomon::compare
