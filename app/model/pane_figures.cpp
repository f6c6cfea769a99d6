#include "model/pane_figures.h"

#include <fmt/core.h>

#include <vector>

#include "common/error.h"

namespace gnomon::app {
namespace {

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

}  // namespace

PaneFigures paneFigures(const Mask& candidate, const Mask& truth,
                        std::span<const std::uint8_t> traced, std::span<const double> weights) {
  if (traced.size() != truth.size()) {
    throw InputError(fmt::format("pane: {} samples, but {} marked as traced or not", truth.size(),
                                 traced.size()));
  }
  const compare::Counts counts =
      compare::countSamples(candidate, truth, weights, answered(truth, traced));
  return {compare::rate(counts, "error_rate"), compare::rate(counts, "false_shadow"),
          compare::rate(counts, "false_light"), compare::rate(counts, "iou"),
          shareTraced(candidate, traced)};
}

}  // namespace gnomon::app
