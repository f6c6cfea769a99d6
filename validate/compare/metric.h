#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::compare {

/// What a metric is measured of.
enum class MetricKind {
  rate,      ///< counts of samples: counts.h
  boundary,  ///< the boundaries of shadows: boundaries.h
  length,    ///< shadows along the light: shadow_length.h
  share,     ///< shares of a light's disc: answer_metrics.h
  penumbra,  ///< the widths of penumbrae: answer_metrics.h
};

/// It decides a metric's range (metricRange) and how it is written.
enum class MetricUnit {
  share,        ///< of something, 0 to 1: written in percent for people
  correlation,  ///< -1 to 1
  distance,     ///< pixels; in an atlas texels
  ratio,        ///< of a length to the truth's, 0 or more
  count,        ///< of samples
};

/// What is known of a metric apart from its formula.
struct MetricTraits {
  std::string_view name;  ///< in files, thresholds and tables
  MetricKind kind;
  MetricUnit unit = MetricUnit::share;
  double perfect = 1;  ///< its value where an answer equals the truth
};

/// All metrics, in the order of the columns of metrics.csv. A new one is a row here and a formula
/// in addition to those of its kind.
inline constexpr auto metricTraits =
    std::to_array<MetricTraits>({{"error_rate", MetricKind::rate, MetricUnit::share, 0},
                                 {"false_shadow", MetricKind::rate, MetricUnit::share, 0},
                                 {"false_light", MetricKind::rate, MetricUnit::share, 0},
                                 {"fpr", MetricKind::rate, MetricUnit::share, 0},
                                 {"fnr", MetricKind::rate, MetricUnit::share, 0},
                                 {"ber", MetricKind::rate, MetricUnit::share, 0},
                                 {"iou", MetricKind::rate},
                                 {"f1", MetricKind::rate},
                                 {"mcc", MetricKind::rate, MetricUnit::correlation},
                                 {"prevalence", MetricKind::rate},
                                 {"assd", MetricKind::boundary, MetricUnit::distance, 0},
                                 {"hd95", MetricKind::boundary, MetricUnit::distance, 0},
                                 {"boundary_iou_1", MetricKind::boundary},
                                 {"boundary_iou_2", MetricKind::boundary},
                                 {"boundary_iou_4", MetricKind::boundary},
                                 {"surface_dice_1", MetricKind::boundary},
                                 {"surface_dice_2", MetricKind::boundary},
                                 {"surface_dice_4", MetricKind::boundary},
                                 {"shadow_length_ratio", MetricKind::length, MetricUnit::ratio},
                                 {"shadow_length_q1", MetricKind::length, MetricUnit::ratio},
                                 {"shadow_length_q3", MetricKind::length, MetricUnit::ratio},
                                 {"shadow_runs", MetricKind::length, MetricUnit::count},
                                 {"mae", MetricKind::share, MetricUnit::share, 0},
                                 {"rmse", MetricKind::share, MetricUnit::share, 0},
                                 {"off_by_more_than_0.1", MetricKind::share, MetricUnit::share, 0},
                                 {"umbra_iou", MetricKind::share},
                                 {"penumbra_iou", MetricKind::share},
                                 {"penumbra_width_ratio", MetricKind::penumbra, MetricUnit::ratio},
                                 {"penumbra_width_q1", MetricKind::penumbra, MetricUnit::ratio},
                                 {"penumbra_width_q3", MetricKind::penumbra, MetricUnit::ratio},
                                 {"penumbra_runs", MetricKind::penumbra, MetricUnit::count}});

/// One of the metrics, as a value.
class MetricId {
 public:
  /// A text that names no metric does not compile.
  // NOLINTNEXTLINE(google-explicit-constructor)
  consteval MetricId(const char* name) : MetricId(*find(name)) {}

  /// @returns none where no metric has the name
  static constexpr std::optional<MetricId> find(std::string_view name) {
    for (std::size_t place = 0; place < metricTraits.size(); ++place) {
      if (metricTraits[place].name == name) return MetricId(place);
    }
    return std::nullopt;
  }
  /// The same of a name that was checked when it was read.
  /// @throws InternalError where no metric has it
  static MetricId of(std::string_view name);

  [[nodiscard]] constexpr std::string_view name() const { return traits().name; }
  [[nodiscard]] constexpr MetricKind kind() const { return traits().kind; }
  [[nodiscard]] constexpr MetricUnit unit() const { return traits().unit; }
  [[nodiscard]] constexpr double perfect() const { return traits().perfect; }
  friend constexpr auto operator<=>(MetricId, MetricId) = default;

 private:
  friend const std::vector<MetricId>& allMetrics();

  constexpr explicit MetricId(std::size_t place) : place_(static_cast<std::uint8_t>(place)) {}
  [[nodiscard]] constexpr const MetricTraits& traits() const { return metricTraits[place_]; }

  std::uint8_t place_;
};

/// Those that much of the program speaks of.
namespace metrics {
inline constexpr MetricId errorRate = "error_rate";
inline constexpr MetricId falseShadow = "false_shadow";
inline constexpr MetricId falseLight = "false_light";
inline constexpr MetricId ber = "ber";
inline constexpr MetricId iou = "iou";
inline constexpr MetricId prevalence = "prevalence";
inline constexpr MetricId mae = "mae";
inline constexpr MetricId shadowLengthRatio = "shadow_length_ratio";
}  // namespace metrics

/// In the order of the table.
const std::vector<MetricId>& allMetrics();
std::vector<MetricId> metricsOfKinds(std::initializer_list<MetricKind> kinds);
std::vector<std::string> namesOf(std::span<const MetricId> metrics);

/// A metric that was measured. Undefined values have no number but a reason; they are never
/// reported as 0 or 1.
struct Metric {
  MetricId id;
  std::optional<double> value;
  std::string_view reason;  ///< why there is no value; empty if there is one

  [[nodiscard]] std::string_view name() const { return id.name(); }
};

/// One of some measured metrics.
/// @throws InternalError where it is not among them
const Metric& metricNamed(std::span<const Metric> metrics, MetricId id);

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
