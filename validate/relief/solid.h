#pragma once

#include <functional>
#include <variant>

#include "common/vec.h"

namespace gnomon::relief {

/// Solid reliefs: functions of a point in space, 0 to 1. A surface that is carved from them has no
/// seams. Lengths in world units. See each for its formula.

/// Gradient noise (Perlin 1985, with the fade curve of 2002) of several octaves:
///   ½ + ½ Σ g_i noise(2^i p / period + i-th shift) / Σ g_i, g_i = gain^i, held within 0 and 1.
/// Most values lie between 0.2 and 0.8. Lattice gradients are the twelve edges of a cube, by a hash
/// of the point and the seed.
struct SolidNoise {
  double period = 1;  ///< of the lowest octave
  int octaves = 3;    ///< 1 to 16
  double gain = 0.5;  ///< 0 to 1: of an octave on the one before it
  int seed = 1;       ///< 0 or more
};

/// Scales or pebbles: CellsPattern in space, of the cells of one jittered point a cube.
struct SolidCells {
  double period = 1;
  double jitter = 0.5;  ///< 0 to 1: share of its cube in which a point may lie
  double groove = 0.2;  ///< width of a rim
  int seed = 1;         ///< 0 or more
};

/// Ridges across a direction: RipplesPattern in space, t the fractional part of
///   (p · direction + meander · w(p)) / period
/// with w = 2 SolidNoise - 1 of one octave, four periods long.
struct SolidRipples {
  double period = 1;
  double windward = 0.7;  ///< 0.01 to 0.99: share of the wavelength that rises
  double meander = 0.4;   ///< that crest planes stray at most
  Vec3 direction{1, 0, 0};
  int seed = 1;  ///< 0 or more: of the meanders
};

using SolidPattern = std::variant<SolidNoise, SolidCells, SolidRipples>;
using SolidFunction = std::function<double(const Vec3& point)>;

/// The function of a solid.
/// @throws InputError naming the key: a length that is not above 0 or over 1e9, a share out of
///   range, a direction of length 0
SolidFunction solidFunction(const SolidPattern& solid);

}  // namespace gnomon::relief
