#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "model/pane_figures.h"
#include "surface/sample_grid.h"

namespace gnomon::app {

/// The order in which a view's samples are traced at rising resolution.
struct ProgressiveOrder {
  /// Indices of samples with a surface, row * width + column, each exactly once. Level by level,
  /// and in a level tile by tile, so that neighbours in the list are neighbours in the picture: the
  /// tracer's rays stay coherent.
  std::vector<std::uint32_t> samples;
  /// Where each level ends in `samples`: level k holds what stride coarsest / 2^k adds.
  std::vector<std::size_t> levelEnds;
};

/// Strides `coarsest`, half of it, … 1: the nodes of a stride are the samples whose column and row
/// are its multiples, and a level has those that no coarser one had. A level in tiles of 4 × 4 of
/// its own nodes, which the tracer takes as one packet of rays.
/// @param coarsest  a power of two
/// @throws InternalError for another one, or for 2³² samples or more
ProgressiveOrder progressiveOrder(const surface::SampleGrid& samples, int coarsest = 16);

/// Answers to look at from what has been traced so far: traced samples have their own; others that
/// of the nearest traced one among the four nodes about them of the finest stride that has any
/// there; none where no stride has, and on the background.
/// @param truth   answers where `traced` holds
/// @param traced  one a sample, non-zero where traced
/// @return answers of the truth's kind
Answers preview(const surface::SampleGrid& samples, const Answers& truth,
                std::span<const std::uint8_t> traced, int coarsest = 16);

}  // namespace gnomon::app
