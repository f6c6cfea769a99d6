#pragma once

#include <cstddef>
#include <vector>

#include "horizon/kernel/padded_map.h"
#include "horizon/reference/ray_crossings.h"

namespace gnomon::horizon {

/// A crossing for the inner loop of the bake: floats, and offsets into the padded map from the
/// texel where the ray starts. The slope at it is (h(from) + share · (h(to) - h(from)) - h0) / r.
struct Tap {
  std::ptrdiff_t from, to;
  float share;
  float distance;         ///< r, texels
  float inverseDistance;  ///< 1 / r
  float tolerance;        ///< slopes here equal a greater slope up to this difference
};

/// The cell that a ray leaves at a crossing, or in which it ends, with the data to find a peak of
/// the slope inside it. Along the ray the height in it is A + B r + C r² with C = -bend · twist.
struct CellPath {
  std::ptrdiff_t cell;  ///< offset of its lower left node
  float enter, length;  ///< r where the ray enters it, and how far it goes in it, texels
  float inverseEnter;   ///< 1 / r, 0 in the first cell
  float u, v;           ///< where it enters, 0 to 1 from the lower left node
  float bend;           ///< -e_x e_y
  /// Times the twist, an upper bound on how far the slope inside exceeds the slopes at both ends:
  /// bend · length² / (4 enter); 0 in the first cell, where the slope has no peak.
  float quarterBulge;
};

/// A stretch of a ray that is skipped or searched as a whole, and the box of nodes that bounds it.
struct Stretch {
  Node corner;         ///< lower left node of the box, folded
  float enter, leave;  ///< r at both ends, texels
  /// Upper bound on how far a peak inside a cell exceeds the slope where the ray leaves the cell.
  float peakRoom;
  float tolerance;  ///< the greatest of its taps
};

/// The ray of one azimuth, the same from every texel. Taps form groups, groups form bundles.
struct AzimuthPlan {
  static constexpr std::size_t groupTaps = 8;
  static constexpr std::size_t bundleGroups = 8;

  Vec2 direction;
  double radius = 0;
  std::vector<Tap> taps;        ///< the last one repeated to fill its group
  std::vector<CellPath> cells;  ///< before each tap
  std::vector<Stretch> groups;
  std::vector<Stretch> bundles;
  BoxSize groupBox, bundleBox;  ///< the boxes that bound every group and every bundle
  bool endsInCell = false;      ///< false if the ray ends on a lattice line
  CellPath lastCell;            ///< in which it ends
  Stretch end;                  ///< the same as a stretch, in a box as a group's
};

/// @param direction  unit; @param radius  D > 0, texels
AzimuthPlan planAzimuth(Vec2 direction, double radius, const PaddedMap& map);

/// Upper bound on the memory of one plan, bytes.
double azimuthPlanBytes(double radius);

}  // namespace gnomon::horizon
