#pragma once

#include "relief/height_field.h"

namespace gnomon {

/// The two texels between whose centres a coordinate lies, and its share of the way, 0 to 1.
struct Neighbours {
  int first, second;
  double share;
};

/// Those of any finite coordinate, texels, by the wrap rule.
Neighbours neighbours(double coordinate, int size, Wrap wrap);

}  // namespace gnomon
