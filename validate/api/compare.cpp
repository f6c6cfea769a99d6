#include "gnomon/compare.h"

#include <fmt/core.h>

#include <algorithm>

#include "api/inner/translated.h"
#include "common/error.h"
#include "common/mask.h"
#include "compare/boundaries.h"
#include "compare/counts.h"
#include "compare/mask_checks.h"
#include "compare/mask_metrics.h"
#include "compare/rates.h"
#include "image/mask_picture.h"

namespace gnomon {
inline namespace api {
namespace {

Mask maskOf(const MaskView& view, const char* what) {
  Mask mask{view.width, view.height, {}};
  const bool isWhole = view.width >= 1 && view.height >= 1 &&
                       view.samples.size() == static_cast<std::size_t>(view.width) *
                                                  static_cast<std::size_t>(view.height);
  if (!isWhole) {
    throw InputError(fmt::format("{}: {} samples found, {} × {} expected", what,
                                 view.samples.size(), view.width, view.height));
  }
  mask.samples.reserve(view.samples.size());
  for (const std::uint8_t value : view.samples) {
    if (value > static_cast<std::uint8_t>(Shade::none)) {
      throw InputError(fmt::format("{}: {} found at index {}; 0, 1 or 2 expected", what, value,
                                   mask.samples.size()));
    }
    mask.samples.push_back(static_cast<Shade>(value));
  }
  return mask;
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
    list.push_back({std::string(metric.name), metric.value, std::string(metric.reason)});
  }
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

MaskPixels readMask(const std::filesystem::path& file) {
  return translated([&] {
    const Mask mask = image::readMaskPicture(file).mask;
    MaskPixels pixels{mask.width, mask.height, {}};
    pixels.samples.reserve(mask.samples.size());
    for (const Shade shade : mask.samples) {
      pixels.samples.push_back(static_cast<std::uint8_t>(shade));
    }
    return pixels;
  });
}

MaskFigures compareMasks(const MaskView& candidate, const MaskView& truth,
                         const CompareOptions& options) {
  return translated([&] {
    Mask right = maskOf(truth, "truth");
    std::optional<Mask> region;
    if (!options.region.empty()) region = regionMask(right, options.region);
    const compare::ComparedMasks masks = compare::commonPixels(
        maskOf(candidate, "candidate"), std::move(right), region ? &*region : nullptr);
    const compare::Counts counts =
        compare::countSamples(masks.candidate, masks.truth, options.weights);
    MaskFigures figures{counts.truePositive,
                        counts.falsePositive,
                        counts.falseNegative,
                        counts.trueNegative,
                        counts.samples,
                        {},
                        {},
                        {}};
    add(figures.metrics, compare::rates(counts));
    add(figures.metrics, compare::compareBoundaries(masks.candidate, masks.truth));
    const compare::ConfidenceInterval confidence =
        compare::maskConfidence({&masks, 1}, options.weights);
    if (confidence.interval) {
      figures.errorInterval = {confidence.interval->low, confidence.interval->high};
    }
    figures.intervalReason = confidence.reason;
    return figures;
  });
}

}  // namespace api
}  // namespace gnomon
