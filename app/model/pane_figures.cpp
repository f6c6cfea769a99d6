#include "model/pane_figures.h"

#include <fmt/core.h>

#include <type_traits>
#include <vector>

#include "common/error.h"

namespace gnomon::app {

namespace {

/// What is compared: everything where `asked` is empty.
struct Selection {
  std::span<const std::uint8_t> traced, asked;
  [[nodiscard]] bool isAsked(std::size_t i) const { return asked.empty() || asked[i] != 0; }
};

/// The samples that the truth has an answer for.
template <typename Map>
std::vector<std::uint8_t> answered(const Map& truth, const Selection& selection) {
  std::vector<std::uint8_t> selected(truth.size(), 0);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const bool isKnown = selection.traced[i] != 0 && isAnswer(valuesOf(truth)[i]);
    selected[i] = isKnown && selection.isAsked(i) ? 1 : 0;
  }
  return selected;
}

template <typename Map>
double shareTraced(const Map& candidate, const Selection& selection) {
  std::size_t all = 0;
  std::size_t done = 0;
  for (std::size_t i = 0; i < candidate.size(); ++i) {
    if (!isAnswer(valuesOf(candidate)[i]) || !selection.isAsked(i)) continue;
    ++all;
    done += selection.traced[i] != 0 ? 1 : 0;
  }
  return all == 0 ? 0 : static_cast<double>(done) / static_cast<double>(all);
}

template <typename Map>
PaneFigures figuresOf(const Map& candidate, const Map& truth, const Selection& selection,
                      std::span<const double> weights) {
  if (selection.traced.size() != truth.size()) {
    throw InputError(fmt::format("pane: {} samples, but {} marked as traced or not", truth.size(),
                                 selection.traced.size()));
  }
  const compare::Counts counts =
      compare::countSamples(candidate, truth, weights, answered(truth, selection));
  return {compare::rate(counts, compare::metrics::errorRate),
          compare::rate(counts, compare::metrics::falseShadow),
          compare::rate(counts, compare::metrics::falseLight),
          compare::rate(counts, compare::metrics::iou),
          counts.samples,
          counts.falsePositive + counts.falseNegative,
          shareTraced(candidate, selection),
          std::is_same_v<Map, Visibility>};
}

/// Calls a function with two maps of one kind.
template <typename Work>
PaneFigures ofOneKind(const Answers& candidate, const Answers& truth, const Work& work) {
  return std::visit(
      [&](const auto& a, const auto& b) -> PaneFigures {
        if constexpr (std::is_same_v<decltype(a), decltype(b)>) {
          return work(a, b);
        } else {
          throw InternalError("pane: a mask against shares of light");
        }
      },
      candidate, truth);
}

}  // namespace

PaneFigures paneFigures(const Answers& candidate, const Answers& truth,
                        std::span<const std::uint8_t> traced, std::span<const double> weights) {
  return ofOneKind(candidate, truth, [&](const auto& a, const auto& b) {
    return figuresOf(a, b, {traced, {}}, weights);
  });
}

PaneFigures paneFigures(const Answers& candidate, const Answers& truth,
                        std::span<const std::uint8_t> traced, const ViewPart& part) {
  return ofOneKind(candidate, truth, [&](const auto& a, const auto& b) {
    return figuresOf(a, b, {traced, pixelsIn(part, a.width, a.height)}, {});
  });
}

}  // namespace gnomon::app
