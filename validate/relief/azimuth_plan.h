#pragma once

#include <cstddef>
#include <vector>

#include "relief/padded_map.h"
#include "relief/ray_crossings.h"

namespace gnomon {

/// A crossing as the baker's inner loop wants it: floats, and offsets into the padded map from the
/// texel where the ray starts. The slope at it is (h(from) + share · (h(to) - h(from)) - h0) / r.
struct Tap {
  std::ptrdiff_t from, to, cell;
  float share;
  float distance;         ///< r, texels
  float inverseDistance;  ///< 1 / r
  float tolerance;        ///< by how much a slope must exceed one found here
  /// Times the cell's twist: by how much at most the slope inside the cell exceeds that at both its
  /// ends, C (leave - enter)² / (4 enter) with C the bend of A + B r + C r². Negative where the
  /// profile is bent the other way.
  float quarterBulge;
};

/// Taps [begin, end) that are skipped or taken together, with all that they touch.
struct TapGroup {
  std::size_t begin, end;
  float inverseEnter, inverseLeave;  ///< 1 / r at the begin and the end
  TexelBox touched;                  ///< relative to the texel where the ray starts
};

/// What all texels share for one azimuth.
struct AzimuthPlan {
  RayCrossings ray;
  std::vector<Tap> taps;
  std::vector<TapGroup> groups;  ///< each of at most 16 taps
  TapGroup lastCell;             ///< no taps: the cell in which the ray ends
};

/// @param direction  unit; @param radius  D > 0, texels
AzimuthPlan planAzimuth(Vec2 direction, double radius, const PaddedMap& map);

/// A bound on the memory of one plan, bytes.
double azimuthPlanBytes(double radius);

}  // namespace gnomon
