#include "model/pane_figures.h"

#include <fmt/core.h>

#include <vector>

#include "common/error.h"
#include "image/images.h"

namespace gnomon {
namespace {

void requireSize(const Mask& candidate, const Mask& truth, std::span<const std::uint8_t> traced) {
  const bool same = candidate.width == truth.width && candidate.height == truth.height &&
                    candidate.size() == truth.size() && traced.size() == truth.size();
  if (same) return;
  throw InputError(
      fmt::format("pane: {} x {} samples, but the truth has {} x {}, {} of them marked "
                  "as traced or not",
                  candidate.width, candidate.height, truth.width, truth.height, traced.size()));
}

/// The samples that the truth has an answer for.
std::vector<std::uint8_t> answered(const Mask& truth, std::span<const std::uint8_t> traced) {
  std::vector<std::uint8_t> selected(truth.size(), 0);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    selected[i] = traced[i] != 0 && truth.samples[i] != Shade::none ? 1 : 0;
  }
  return selected;
}

double shareTraced(const Mask& candidate, std::span<const std::uint8_t> traced) {
  std::size_t all = 0;
  std::size_t done = 0;
  for (std::size_t i = 0; i < candidate.size(); ++i) {
    if (candidate.samples[i] == Shade::none) continue;
    ++all;
    done += traced[i] != 0 ? 1 : 0;
  }
  return all == 0 ? 0 : static_cast<double>(done) / static_cast<double>(all);
}

Mask onlyWhere(Mask mask, const std::vector<std::uint8_t>& selected) {
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (selected[i] == 0) mask.samples[i] = Shade::none;
  }
  return mask;
}

}  // namespace

PaneFigures paneFigures(const Mask& candidate, const Mask& truth,
                        std::span<const std::uint8_t> traced, std::span<const double> weights) {
  requireSize(candidate, truth, traced);
  const Counts counts = countSamples(candidate, truth, weights, answered(truth, traced));
  return {rate(counts, "error_rate"), rate(counts, "false_shadow"), rate(counts, "false_light"),
          rate(counts, "iou"), shareTraced(candidate, traced)};
}

Image paneDifference(const Mask& candidate, const Mask& truth,
                     std::span<const std::uint8_t> traced) {
  requireSize(candidate, truth, traced);
  const std::vector<std::uint8_t> selected = answered(truth, traced);
  return differenceImage(onlyWhere(candidate, selected), onlyWhere(truth, selected));
}

}  // namespace gnomon
