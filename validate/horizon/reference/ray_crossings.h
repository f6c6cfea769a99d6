#pragma once

#include <cstddef>
#include <vector>

#include "common/vec.h"
#include "horizon/stored_table.h"
#include "horizon/table_file.h"

namespace gnomon::horizon {

/// Unit vector of azimuth φ_m = 2πm/M, exact where it lies on an axis, with equal components on a
/// diagonal, and with the same digits in every quadrant.
Vec2 azimuthDirection(int azimuth, int azimuths);

/// A node of the lattice of texel centres, relative to the one that the ray starts from (or to the
/// lower left one of the cell that it starts in).
struct Node {
  int x, y;
};

/// The part of a ray inside one cell of the lattice of texel centres (a unit square between four
/// of them) and the point where it leaves the cell, on the lattice line between two nodes.
struct Crossing {
  double enter;   ///< r where the ray enters the cell, texels
  double leave;   ///< r where it leaves it
  Node cell;      ///< the cell's lower left node
  Node from, to;  ///< the height at `leave` is h(from) + share · (h(to) - h(from))
  double share;   ///< 0 to 1; 0 on a node
};

/// A ray cut at every lattice line. From one texel centre the cuts are the same as from any other,
/// since all of them are nodes.
struct RayCrossings {
  Vec2 direction;                   ///< unit
  std::vector<Crossing> crossings;  ///< by distance; lines met at one node count once
  double radius;                    ///< D, where the ray ends
  Node lastCell;                    ///< the cell in which it ends
  /// Where the ray enters the last cell; equal to `radius` if it ends on a lattice line.
  double lastEnter;
};

/// @param direction  unit; @param radius  D > 0, texels
/// @param offset     of the ray's origin from its node, texels, 0 ≤ offset < 1: 0 for a texel
/// centre
RayCrossings cutRay(Vec2 direction, double radius, Vec2 offset = Vec2(0));

/// A table's value as shaders filter it (`filter = "exact"`): linear between texel centres in x and
/// y and between azimuths, in double.
/// @param texel    any finite position, texels
/// @param azimuth  radians, any finite angle
double filteredValue(const StoredTable& table, const TableShape& shape, Vec2 texel, double azimuth);

}  // namespace gnomon::horizon
