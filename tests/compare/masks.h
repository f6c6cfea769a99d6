#pragma once

#include <rapidcheck.h>

#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

#include "common/mask.h"

namespace gnomon::test {

/// A one-row mask drawn as text: '.' lit, '#' shadowed, ' ' no sample.
inline Mask row(std::string_view picture) {
  Mask mask{static_cast<int>(picture.size()), 1, {}};
  for (const char c : picture) {
    mask.samples.push_back(c == '#' ? Shade::shadowed : c == '.' ? Shade::lit : Shade::none);
  }
  return mask;
}

/// Lit becomes shadowed and the other way round.
inline Mask complement(Mask mask) {
  for (Shade& shade : mask.samples) {
    if (shade != Shade::none) shade = shade == Shade::lit ? Shade::shadowed : Shade::lit;
  }
  return mask;
}

/// Two masks of one view with weights and a selection, as countSamples takes them.
struct Comparison {
  Mask candidate, truth;
  std::vector<double> weights;
  std::vector<std::uint8_t> selected;
};

/// Random sides of 0 to 48 samples, a fifth of them background, weights of eleven magnitudes.
inline Comparison arbitraryComparison() {
  Comparison c;
  const int width = *rc::gen::inRange(0, 49);
  const int height = *rc::gen::inRange(0, 49);
  c.candidate.width = c.truth.width = width;
  c.candidate.height = c.truth.height = height;
  for (int i = 0; i < width * height; ++i) {
    const bool background = *rc::gen::inRange(0, 5) == 0;
    const auto shade = [&] {
      const bool shadowed = *rc::gen::arbitrary<bool>();
      return background ? Shade::none : shadowed ? Shade::shadowed : Shade::lit;
    };
    c.candidate.samples.push_back(shade());
    c.truth.samples.push_back(shade());
    c.weights.push_back(*rc::gen::inRange(0, 1000) * std::pow(10.0, *rc::gen::inRange(-5, 6)));
    c.selected.push_back(*rc::gen::inRange<std::uint8_t>(0, 3));
  }
  return c;
}

/// The picture with its rows as columns.
inline Mask transposed(const Mask& mask) {
  Mask turned{mask.height, mask.width, {}};
  for (int x = 0; x < mask.width; ++x) {
    for (int y = 0; y < mask.height; ++y) {
      turned.samples.push_back(mask.samples[static_cast<std::size_t>(y * mask.width + x)]);
    }
  }
  return turned;
}

}  // namespace gnomon::test
