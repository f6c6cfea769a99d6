#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "compare/rates.h"
#include "model/answers.h"
#include "model/view_part.h"

namespace gnomon::app {

/// What a pane says of its method, against as much of the truth as has been traced.
struct PaneFigures {
  /// Over the traced samples. Of shares the error rate is the mean of |ΔV|.
  compare::Metric errorRate, falseShadow, falseLight, iou;
  std::size_t samples = 0;  ///< how many were compared
  double wrong = 0;         ///< how many of them are wrong; of shares the sum of |ΔV|
  double tracedShare = 0;   ///< of the samples that were asked about, 0 to 1
  bool isSoft = false;      ///< of shares, not of masks
};

/// The figures of `compare` over the traced samples; with all of them traced those that a run
/// reports for this view and light in the region "all". Samples without a frame, for which the
/// truth has no answer, do not count.
/// @param truth    answers where `traced` holds; anything elsewhere
/// @param traced   one a sample, non-zero where the truth has been traced
/// @param weights  as in countSamples: areas in an atlas view, empty for a camera's
/// @throws InputError as countSamples: for other sizes, and for a candidate without an answer at a
///   traced sample; InternalError for answers of two kinds
PaneFigures paneFigures(const Answers& candidate, const Answers& truth,
                        std::span<const std::uint8_t> traced, std::span<const double> weights = {});

/// The same over the samples in a part of a camera's view alone.
PaneFigures paneFigures(const Answers& candidate, const Answers& truth,
                        std::span<const std::uint8_t> traced, const ViewPart& part);

}  // namespace gnomon::app
