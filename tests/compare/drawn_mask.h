#pragma once

#include <functional>

#include "compare/masks.h"

namespace gnomon::test {

/// A mask that is dark where `isDark(x, y)` says so.
inline Mask drawn(int width, int height, const std::function<bool(int, int)>& isDark) {
  Mask mask{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      mask.samples.push_back(isDark(x, y) ? Shade::shadowed : Shade::lit);
    }
  }
  return mask;
}

}  // namespace gnomon::test
