#pragma once

#include <array>
#include <optional>
#include <vector>

#include "common/vec.h"

namespace gnomon {

/// A semi-sharp edge between two vertices of a cage, OpenSubdiv's sharpness: 0 smooth, 10 sharp.
struct Crease {
  std::array<int, 2> vertices;
  double sharpness;
};

/// A semi-sharp vertex.
struct SharpVertex {
  int vertex;
  double sharpness;
};

/// What the limit surface does at the border of an open cage.
enum class CageBorder {
  edgesAndCorners,  ///< it interpolates border edges as curves, and corner vertices
  support,          ///< the outermost faces only support the inner ones and have no limit surface
};

/// The faces with a limit surface form a regular grid: face `row * columns + column`, s along the
/// columns, t along the rows. uv is affine over the whole grid: uv = (column + s, row + t) /
/// (columns, rows).
struct GridChart {
  int columns;
  int rows;
};

/// A Catmull-Clark control cage of quadrilaterals with face-varying texture coordinates.
/// Corner k of face f is `faceVertices[4 f + k]` with uv `uvs[faceUvs[4 f + k]]`. Corners run
/// counter-clockwise seen from outside; (s, t) is (0,0), (1,0), (1,1), (0,1) at corners 0 to 3.
/// uv is interpolated bilinearly inside a face, as a GPU does on a mesh of the same faces.
struct Cage {
  std::vector<Vec3> positions;
  std::vector<int> faceVertices;
  std::vector<Vec2> uvs;
  std::vector<int> faceUvs;
  std::vector<Crease> creases;
  std::vector<SharpVertex> sharpVertices;
  CageBorder border = CageBorder::edgesAndCorners;
  std::optional<GridChart> grid;

  [[nodiscard]] int faceCount() const { return static_cast<int>(faceVertices.size() / 4); }
};

}  // namespace gnomon
