#include "study/spec/threshold_limits.h"

#include <fmt/core.h>

#include <algorithm>

#include "compare/metric_range.h"
#include "truth/region.h"

namespace gnomon::study {
namespace {

compare::PictureExtent largestExtent(const StudySpec& study, const std::string& view) {
  compare::PictureExtent largest;
  for (const ViewSpec& candidate : study.views) {
    if (!view.empty() && candidate.name != view) continue;
    const compare::PictureExtent extent =
        fullExtent(candidate, study.quick, study.relief.texelsPerUv(), study.cage.faceCount());
    largest.diagonal = std::max(largest.diagonal, extent.diagonal);
    largest.samples = std::max(largest.samples, extent.samples);
  }
  return largest;
}

/// Whether a metric has the same value in a region whatever a method answers: the truth lights all
/// of its samples, or shadows all.
bool isSettledIn(std::string_view region, compare::MetricId metric,
                 const std::vector<std::string>& partNames) {
  if (region == truth::regionName(truth::Region::lit)) return compare::isSettledByLight(metric);
  const bool isDark = std::any_of(
      truth::reportedRegions.begin(), truth::reportedRegions.end(), [&](truth::Region candidate) {
        return truth::isDark(candidate) && region == truth::regionName(candidate);
      });
  const std::vector<std::string> parts = truth::partRegions(partNames);
  const auto receivers = static_cast<std::ptrdiff_t>(partNames.size());
  const bool isShaded = std::find(parts.begin() + receivers, parts.end(), region) != parts.end();
  return (isDark || isShaded) && compare::isSettledByShadow(metric);
}

std::optional<double> readLimit(const TomlReader& section, const char* key,
                                const compare::MetricRange& range) {
  const toml::node* node = section.find(key);
  if (node == nullptr) return std::nullopt;
  if (!node->is_string()) return section.number(key, anyNumber);
  const std::string text = section.text(key);
  const auto limit = text.ends_with('%') ? compare::limitOfText(text, range) : std::nullopt;
  if (!limit) {
    section.fail(key,
                 fmt::format("\"{}\" found, {} expected", text,
                             range.isShare ? "a number, or a percentage as \"5 %\"" : "a number"));
  }
  return limit;
}

}  // namespace

void readLimits(const TomlReader& section, const StudySpec& study, Gate& threshold) {
  const compare::MetricRange range =
      compare::metricRange(threshold.metric, largestExtent(study, threshold.view));
  threshold.minimum = readLimit(section, "min", range);
  threshold.maximum = readLimit(section, "max", range);
  if (!threshold.minimum && !threshold.maximum) section.fail("max", "`max` or `min` expected");
  if (isSettledIn(threshold.region, threshold.metric, study.cage.partNames)) {
    section.fail("region",
                 fmt::format("\"{}\" found, but there the region alone decides {}, whatever a "
                             "method answers",
                             threshold.region, threshold.metric.name()));
  }
  const auto require = [&](const char* key, std::optional<double> limit) {
    if (!limit) return;
    section.blame(key, [&] { compare::requireInRange(*limit, threshold.metric, range); });
  };
  require("max", threshold.maximum);
  require("min", threshold.minimum);
  section.blame(threshold.maximum ? "max" : "min", [&] {
    compare::requireMissable(threshold.minimum, threshold.maximum, threshold.metric, range);
  });
}

}  // namespace gnomon::study
