#pragma once

#include <cstddef>

#include "common/mask.h"
#include "common/visibility.h"

namespace gnomon::compare {

/// Whether a sample has an answer: lit or shadowed.
inline bool isAnswer(Shade shade) {
  return shade == Shade::lit || shade == Shade::shadowed;
}

/// Whether a mask has an answer wherever the truth has one. Both are of one size.
bool answersAllOf(const Mask& truth, const Mask& candidate);

/// @throws InputError unless both masks hold what their widths and heights promise and are of one
///   size
void requireSameView(const Mask& candidate, const Mask& truth);

/// The same of maps of visibility.
void requireSameView(const Visibility& candidate, const Visibility& truth);

/// @throws InputError unless there is one value a sample, or none at all
void requireOnePerSample(std::size_t found, std::size_t samples, const char* what);

}  // namespace gnomon::compare
