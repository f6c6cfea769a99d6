#pragma once

#include <functional>
#include <memory>
#include <span>

#include "gnomon/exception.h"

namespace gnomon {
inline namespace api {

/// A height map h(x, y): the bilinear interpolant of its texels. Texel (i, j) is
/// `texels[j * width + i]`, its centre lies at (i + 0.5, j + 0.5), and row 0 is at v = 0. The
/// texels stay the caller's.
struct HeightMap {
  int width = 0, height = 0;      ///< texels, at least 1
  std::span<const float> texels;  ///< heights from -1e6 to 1e6
  bool repeats = true;            ///< outside the map; otherwise the outermost texels go on
};

/// Horizons of a flat height map. With the unit vector e of azimuth φ_m = 2πm/M, counter-clockwise
/// from +x, and the search radius D, each texel centre p has
///   slope     sup over 0 < r ≤ D of (h(p + r e) - h(p)) / r: the tangent of the horizon's angle,
///             height units per texel (Max 1988)
///   distance  the smallest r that attains the slope, texels; 0 where the supremum is the
///             derivative at p (Onoue, Max & Nishita 2004)
/// Both are at index (m * height + y) * width + x.
struct HorizonMaps {
  int width = 0, height = 0;
  int azimuths = 0;  ///< M
  std::span<const float> slopes;
  std::span<const float> distances;
  std::shared_ptr<const void> storage;  ///< owns what both spans show
};

/// Computes the exact suprema of the bilinear function, up to float rounding, on all threads. The
/// bytes depend neither on the number of threads nor on the processor.
/// @param azimuths  M, 1 to 1024
/// @param radius    D, texels, above 0 and at most 1e5
/// @param progress  told what share is done, 0 to 1, from any thread but never from two at once;
///   what it throws cancels the bake and comes out of it
/// @throws Exception  badInput for a size, height or setting out of range; internal where the maps
///   do not fit into memory
GNOMON_API HorizonMaps bakeHorizons(const HeightMap& map, int azimuths, double radius,
                                    const std::function<void(double share)>& progress = {});

}  // namespace api
}  // namespace gnomon
