#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/exception.h"

namespace gnomon {
inline namespace api {

/// A mask: 1 lit, 0 shadowed, 2 no answer; row by row, row 0 at the top. As in files, where white
/// is lit, and as V of `ShareMap`.
struct MaskMap {
  int width = 0, height = 0;
  std::vector<std::uint8_t> samples;  ///< width × height
};

/// V, the share of a light's disc that each sample sees: 0 none of it, 1 all of it, NaN no answer;
/// row by row, row 0 at the top.
struct ShareMap {
  int width = 0, height = 0;
  std::vector<float> shares;  ///< width × height
};

/// Reads a picture of a mask as Gnomon writes it: white lit, black shadowed, mid-grey no answer.
/// @throws Exception  badInput naming the file, for any other value too
GNOMON_API MaskMap readMask(const std::filesystem::path& file);

/// Reads a picture of shares: values from 0 to 1 are V, alpha 0 or Gnomon's grey no answer. A mask
/// is one of zeros and ones.
/// @throws Exception  badInput naming the file, for any other value too
GNOMON_API ShareMap readShares(const std::filesystem::path& file);

/// Which samples count, and how much.
struct CompareOptions {
  std::span<const double> weights;       ///< one for each sample, at least 0; empty for 1 each
  std::span<const std::uint8_t> region;  ///< nonzero where a sample counts; empty for everywhere
};

/// One figure of a comparison. Where it is undefined it has a reason and no value.
struct MaskMetric {
  std::string name;
  std::optional<double> value;
  std::string reason;
};

/// A candidate mask against the truth; positive means shadowed. The four cells are sums of weights.
struct MaskFigures {
  double truePositive = 0;   ///< shadowed in both
  double falsePositive = 0;  ///< false shadow
  double falseNegative = 0;  ///< false light
  double trueNegative = 0;   ///< lit in both
  std::size_t samples = 0;   ///< that were compared
  /// In this order: error_rate (FP + FN) / all, false_shadow, false_light, fpr, fnr, ber, iou, f1,
  /// mcc, prevalence; then those of the boundaries, by samples without weights, in pixels: assd,
  /// hd95, boundary_iou_1, _2, _4, surface_dice_1, _2, _4. docs/metrics.md defines them.
  std::vector<MaskMetric> metrics;

  /// The 95 % interval of error_rate, by blocks of the picture; docs/metrics.md says of what.
  std::optional<std::array<double, 2>> errorInterval;
  std::string intervalReason;  ///< why there is none; empty if there is one
  /// What to look at before the figures are used: that one of the masks seems inverted. Empty if
  /// there is nothing.
  std::string notice;

  /// The value of a metric, if it is defined.
  /// @throws Exception  badInput for a name that is not in the list
  [[nodiscard]] GNOMON_API std::optional<double> value(std::string_view metric) const;
};

/// Compares where the truth has an answer and the region holds. Without weights and options the
/// figures are those of `gnomon compare`.
/// @throws Exception  badInput where sizes differ, a sample is not 0, 1 or 2, a weight is negative
///   or not finite, nothing is left to compare, or the candidate lacks an answer that counts
GNOMON_API MaskFigures compareMasks(const MaskMap& candidate, const MaskMap& truth,
                                    const CompareOptions& options = {});

/// The same of shares under a light with a disc. Each sample is divided among the four cells, see
/// docs/metrics.md: error_rate is the mean of |V - V_truth|. Boundaries are those of both maps cut
/// at V < 0.5. After them come mae, rmse, off_by_more_than_0.1, umbra_iou and penumbra_iou.
/// @throws Exception  badInput as `compareMasks`, and for a share that is not 0 to 1 or NaN
GNOMON_API MaskFigures compareShares(const ShareMap& candidate, const ShareMap& truth,
                                     const CompareOptions& options = {});

}  // namespace api
}  // namespace gnomon
