#pragma once

#include <array>
#include <vector>

#include "common/camera.h"
#include "displaced/displaced_mesh.h"

namespace gnomon::render {

// A flat scene whose picture is known in closed form: a floor, and a box that floats over it.

/// corner + s along + t across, s and t from 0 to 1; `along` and `across` are at right angles, and
/// the outside is where along × across points.
struct Rectangle {
  Vec3 corner, along, across;
};

/// The floor is face 0, the box's sides are faces 1 to 6.
const std::array<Rectangle, 7>& boxOverFloor();

/// Its triangles: every rectangle cut into some quadrilaterals a side, as makeBaseMesh cuts a face,
/// with the neighbours across the box's edges.
displaced::DisplacedMesh boxOverFloorMesh();

/// The surface point that a pixel shows.
struct SeenPoint {
  int face = -1;          ///< -1 for none
  Vec2 st{0, 0};          ///< its place there
  bool isTurned = false;  ///< outside turned from the light
  bool isHidden = false;  ///< another rectangle, or its own from behind, is before the light
  /// Whether it and its eight neighbours show the same face and are lit alike, so that rounding
  /// cannot change the answer.
  bool isClear = false;
};

/// The scene's pixels in a picture, row 0 at the top: for each the nearest rectangle whose outside
/// it sees, and a ray from there to the light.
/// @param light  unit vector toward the light
std::vector<SeenPoint> seenPoints(const Camera& camera, const Vec3& light);

}  // namespace gnomon::render
