#pragma once

#include <cmath>
#include <cstddef>
#include <variant>
#include <vector>

#include "common/mask.h"
#include "common/visibility.h"

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

}  // namespace gnomon::app
