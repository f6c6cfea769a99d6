#include "model/pane_figures.h"

#include <fmt/core.h>

#include <type_traits>
#include <vector>

#include "common/error.h"

namespace gnomon::app {
namespace {

/// The samples that the truth has an answer for.
template <typename Map>
std::vector<std::uint8_t> answered(const Map& truth, std::span<const std::uint8_t> traced) {
  std::vector<std::uint8_t> selected(truth.size(), 0);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    selected[i] = traced[i] != 0 && isAnswer(valuesOf(truth)[i]) ? 1 : 0;
  }
  return selected;
}

template <typename Map>
double shareTraced(const Map& candidate, std::span<const std::uint8_t> traced) {
  std::size_t all = 0;
  std::size_t done = 0;
  for (std::size_t i = 0; i < candidate.size(); ++i) {
    if (!isAnswer(valuesOf(candidate)[i])) continue;
    ++all;
    done += traced[i] != 0 ? 1 : 0;
  }
  return all == 0 ? 0 : static_cast<double>(done) / static_cast<double>(all);
}

template <typename Map>
PaneFigures figuresOf(const Map& candidate, const Map& truth, std::span<const std::uint8_t> traced,
                      std::span<const double> weights) {
  if (traced.size() != truth.size()) {
    throw InputError(fmt::format("pane: {} samples, but {} marked as traced or not", truth.size(),
                                 traced.size()));
  }
  const compare::Counts counts =
      compare::countSamples(candidate, truth, weights, answered(truth, traced));
  return {compare::rate(counts, "error_rate"),  compare::rate(counts, "false_shadow"),
          compare::rate(counts, "false_light"), compare::rate(counts, "iou"),
          shareTraced(candidate, traced),       std::is_same_v<Map, Visibility>};
}

}  // namespace

PaneFigures paneFigures(const Answers& candidate, const Answers& truth,
                        std::span<const std::uint8_t> traced, std::span<const double> weights) {
  return std::visit(
      [&](const auto& a, const auto& b) -> PaneFigures {
        if constexpr (std::is_same_v<decltype(a), decltype(b)>) {
          return figuresOf(a, b, traced, weights);
        } else {
          throw InternalError("pane: a mask against shares of light");
        }
      },
      candidate, truth);
}

}  // namespace gnomon::app
