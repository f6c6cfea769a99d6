#pragma once

namespace gnomon::relief {

/// How a map or table goes on outside its texels.
enum class Wrap { repeat, clamp };

/// The axes of a map at whose ends the surface ends too.
struct Border {
  bool x = false, y = false;
  bool operator==(const Border&) const = default;
};

/// The index of texel i by the wrap rule: i modulo size, or i clamped to [0, size).
int wrappedIndex(int i, int size, Wrap wrap);

/// The two texels between whose centres a coordinate lies, and its share of the way from the first
/// to the second, 0 to 1.
struct Neighbours {
  int first, second;
  double share;
};

/// @param coordinate  any finite one, texels; the centre of texel i lies at i + 0.5
Neighbours neighbours(double coordinate, int size, Wrap wrap);

}  // namespace gnomon::relief
