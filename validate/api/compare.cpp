#include "gnomon/compare.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "api/inner/conversions.h"
#include "common/error.h"
#include "common/mask.h"
#include "compare/answer_metrics.h"
#include "compare/boundaries.h"
#include "compare/counts.h"
#include "image/mask_picture.h"

namespace gnomon {
inline namespace api {
namespace {

void requireWhole(int width, int height, std::size_t samples, const char* what) {
  const bool isWhole =
      width >= 1 && height >= 1 &&
      samples == static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (isWhole) return;
  throw InputError(
      fmt::format("{}: {} samples found, {} × {} expected", what, samples, width, height));
}

Mask maskOf(const MaskMap& view, const char* what) {
  Mask mask{view.width, view.height, {}};
  requireWhole(view.width, view.height, view.samples.size(), what);
  mask.samples.reserve(view.samples.size());
  for (const std::uint8_t value : view.samples) {
    const std::optional<Shade> shade = shadeOf(value);
    if (!shade) {
      throw InputError(fmt::format("{}: {} found at index {}; 0, 1 or 2 expected", what, value,
                                   mask.samples.size()));
    }
    mask.samples.push_back(*shade);
  }
  return mask;
}

/// Shares of another size or range are refused where they are compared.
Visibility mapOf(const ShareMap& map, const char* what) {
  requireWhole(map.width, map.height, map.shares.size(), what);
  return {map.width, map.height, map.shares};
}

/// A region as a mask that is lit where samples count.
Mask regionMask(const Mask& truth, std::span<const std::uint8_t> region) {
  compare::requireOnePerSample(region.size(), truth.size(), "values of the region");
  Mask mask{truth.width, truth.height, {}};
  mask.samples.reserve(region.size());
  for (const std::uint8_t counts : region) {
    mask.samples.push_back(counts != 0 ? Shade::lit : Shade::shadowed);
  }
  return mask;
}

void add(std::vector<MaskMetric>& list, const std::vector<compare::Metric>& metrics) {
  for (const compare::Metric& metric : metrics) {
    list.push_back({std::string(metric.name()), metric.value, std::string(metric.reason)});
  }
}

/// The region of some options, if there is one.
std::optional<Mask> regionOf(const Mask& truth, const CompareOptions& options) {
  if (options.region.empty()) return std::nullopt;
  return regionMask(truth, options.region);
}

/// The figures of masks, or of shares where there are any.
MaskFigures figuresOf(const compare::ComparedMasks& masks, std::span<const double> weights) {
  const bool isSoft = masks.truthShares.size() > 0;
  const compare::Counts counts = compare::countsOf(masks, weights);
  MaskFigures figures{counts.truePositive,
                      counts.falsePositive,
                      counts.falseNegative,
                      counts.trueNegative,
                      counts.samples,
                      {},
                      {},
                      {},
                      compare::invertedNotice(masks, weights).value_or("")};
  add(figures.metrics, compare::rates(counts));
  add(figures.metrics, compare::compareBoundaries(masks.candidate, masks.truth));
  if (isSoft) {
    add(figures.metrics, compare::shareMetrics(masks.candidateShares, masks.truthShares, weights));
  }
  const compare::ConfidenceInterval confidence = compare::maskConfidence({&masks, 1}, weights);
  if (confidence.interval) {
    figures.errorInterval = {confidence.interval->low, confidence.interval->high};
  }
  figures.intervalReason = confidence.reason;
  return figures;
}

}  // namespace

std::optional<double> MaskFigures::value(std::string_view metric) const {
  const auto found = std::find_if(metrics.begin(), metrics.end(),
                                  [&](const MaskMetric& one) { return one.name == metric; });
  if (found == metrics.end()) {
    throw Exception(FailureKind::badInput, fmt::format("no metric is named \"{}\"", metric));
  }
  return found->value;
}

MaskMap readMask(const std::filesystem::path& file) {
  return translated([&] {
    const Mask mask = image::readMaskPicture(file).mask;
    MaskMap pixels{mask.width, mask.height, {}};
    pixels.samples.reserve(mask.samples.size());
    for (const Shade shade : mask.samples) {
      pixels.samples.push_back(byteOf(shade));
    }
    return pixels;
  });
}

ShareMap readShares(const std::filesystem::path& file) {
  return translated([&] {
    Visibility map = image::readSharePicture(file);
    return ShareMap{map.width, map.height, std::move(map.shares)};
  });
}

MaskFigures compareMasks(const MaskMap& candidate, const MaskMap& truth,
                         const CompareOptions& options) {
  return translated([&] {
    Mask right = maskOf(truth, "truth");
    const std::optional<Mask> region = regionOf(right, options);
    return figuresOf(compare::commonPixels(maskOf(candidate, "candidate"), std::move(right),
                                           region ? &*region : nullptr),
                     options.weights);
  });
}

MaskFigures compareShares(const ShareMap& candidate, const ShareMap& truth,
                          const CompareOptions& options) {
  return translated([&] {
    const Visibility right = mapOf(truth, "truth");
    const std::optional<Mask> region = regionOf(cutInHalf(right), options);
    return figuresOf(
        compare::commonPixels(mapOf(candidate, "candidate"), right, region ? &*region : nullptr),
        options.weights);
  });
}

}  // namespace api
}  // namespace gnomon
