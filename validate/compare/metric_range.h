#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "compare/metric.h"

namespace gnomon::compare {

/// What a picture's size leaves possible.
struct PictureExtent {
  double diagonal = 0;  ///< longest distance in it, in the unit of its boundaries' distances
  double samples = 0;
};

/// The values that a metric can have, both ends included.
struct MetricRange {
  double least = 0;
  double most = 1;
  bool isShare = true;  ///< of something, so that it can be given in percent
};

/// The range of a metric, by its unit:
///   share        0 to 1
///   correlation  -1 to 1
///   distance     0 to the picture's diagonal
///   ratio        0 to that over the shortest shadow measured, `leastRunSamples`
///   count        0 to the picture's samples
MetricRange metricRange(MetricId metric, const PictureExtent& picture);

/// Whether a metric is the truth's alone, whatever a candidate does: prevalence, shadow_runs. A
/// gate on it judges the scene, and no method.
bool isOfTruthAlone(MetricId metric);

/// Whether a metric has one value, whatever a candidate does, where the truth lights all samples;
/// where it shadows all.
bool isSettledByLight(MetricId metric);
bool isSettledByShadow(MetricId metric);

/// Reads a limit: a number, or of a share also a percentage, "5 %" for 0.05. Both are the double
/// nearest to the decimal number that is written.
/// @return none for other text
std::optional<double> limitOfText(std::string_view text, const MetricRange& range);

/// A limit must be a value that the metric can have. Its message says what was found and expected.
/// @throws InputError
void requireInRange(double limit, MetricId metric, const MetricRange& range);

/// A gate must have values that fail it and values that pass it: a maximum below the range's upper
/// end or a minimum above its lower one, and no minimum above the maximum.
/// @throws InputError
void requireMissable(std::optional<double> minimum, std::optional<double> maximum, MetricId metric,
                     const MetricRange& range);

}  // namespace gnomon::compare
