#include "relief/wrap.h"

#include <algorithm>
#include <cmath>

namespace gnomon::relief {

int wrappedIndex(int i, int size, Wrap wrap) {
  if (wrap == Wrap::clamp) return std::clamp(i, 0, size - 1);
  if (i >= 0 && i < size) return i;  // the common case, without a division
  const int remainder = i % size;
  return remainder < 0 ? remainder + size : remainder;
}

Neighbours neighbours(double coordinate, int size, Wrap wrap) {
  // Reduced in floating point first: the coordinate may exceed what an int holds.
  double c = coordinate - 0.5;
  if (wrap == Wrap::repeat) {
    // May be negative: wrappedIndex sees to that.
    if (std::abs(c) >= size) c = std::fmod(c, size);
  } else {
    c = std::clamp(c, 0.0, static_cast<double>(size - 1));
  }
  const double below = std::floor(c);
  const int first = static_cast<int>(below);
  return {wrappedIndex(first, size, wrap), wrappedIndex(first + 1, size, wrap), c - below};
}

}  // namespace gnomon::relief
