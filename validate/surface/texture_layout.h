#pragma once

#include <array>
#include <vector>

#include "common/vec.h"
#include "surface/limit_surface.h"

namespace gnomon::surface {

/// How the faces of a surface lie in the plane of the texture: in charts, and where these lie over
/// each other. Each repeat of a texture that repeats is a place of its own, since maps of the
/// surface have a texel of their own there.
struct TextureLayout {
  /// The chart of every face, from 1 in the order of their first faces. A chart is connected and
  /// one to one: its faces continue each other's texture coordinates over common edges (equal at
  /// both ends, neither mirrored beside the other), and no two of them overlap. So a surface that
  /// folds over itself in the texture has several.
  std::vector<int> charts;
  int chartCount = 0;
  /// Whether no two faces overlap: each place of the texture belongs to one place of the surface.
  bool isOneToOne = true;
  /// The share of the surface's area, 0 to 1, whose texture coordinates lie under a second face.
  /// Within a face areas count by the texture.
  double sharedArea = 0;
};

/// Two faces overlap if the interiors of two of their triangles in the texture do; edges and
/// corners that touch are no overlap. The triangles are those of the cage, a quadrilateral being
/// cut along the diagonal inside it. The decision is exact (orientation), areas are rounded.
TextureLayout textureLayout(const LimitSurface& surface);

/// The sign of twice the area of a triangle, 1 counter-clockwise, -1 clockwise, 0 on a line: exact
/// for all coordinates whose products neither overflow nor underflow (Shewchuk 1997).
int orientation(Vec2 a, Vec2 b, Vec2 c);

/// A triangle in the plane of the texture, its corners counter-clockwise.
using TextureTriangle = std::array<Vec2, 3>;

/// Whether a place lies inside, and not on an edge: exact as `orientation`.
bool isInside(const TextureTriangle& triangle, Vec2 place);

/// The triangles of a quadrilateral in the texture, without those on a line.
std::vector<TextureTriangle> trianglesOf(const std::array<Vec2, 4>& corners);

}  // namespace gnomon::surface
