#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "common/mask.h"
#include "compare/counts.h"
#include "model/picking.h"

namespace gnomon::app {

/// What a method or the truth says of all samples of a view: a mask where the light is a point, the
/// share of its disc that each sample sees where it has one.
using Answers = std::variant<Mask, Visibility>;

inline bool isSoft(const Answers& answers) {
  return std::holds_alternative<Visibility>(answers);
}

/// One sample's answer, in a mask and in a map of shares.
inline bool isAnswer(Shade shade) {
  return shade != Shade::none;
}
inline bool isAnswer(float share) {
  return !std::isnan(share);
}

/// One a sample.
inline std::vector<Shade>& valuesOf(Mask& mask) {
  return mask.samples;
}
inline const std::vector<Shade>& valuesOf(const Mask& mask) {
  return mask.samples;
}
inline std::vector<float>& valuesOf(Visibility& map) {
  return map.shares;
}
inline const std::vector<float>& valuesOf(const Visibility& map) {
  return map.shares;
}

/// What a sample without an answer has.
inline Shade absentIn(const Mask& /*mask*/) {
  return Shade::none;
}
inline float absentIn(const Visibility& /*map*/) {
  return noSample;
}

/// A map of a size in which no sample has an answer.
template <typename Map>
Map emptyMap(int width, int height) {
  Map map{width, height, {}};
  valuesOf(map).assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                       absentIn(map));
  return map;
}

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
