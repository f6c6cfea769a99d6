#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "common/vec.h"

namespace gnomon::surface {

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

/// Which limit surface a cage stands for.
enum class SubdivisionScheme {
  catmullClark,  ///< of quadrilaterals (Catmull & Clark 1978): bicubic B-splines where regular
  loop,          ///< of triangles (Loop 1987): quartic box splines where regular
};

/// The faces with a limit surface form a regular grid: face `row * columns + column`, s along the
/// columns, t along the rows. uv is affine over the whole grid: uv = (column + s, row + t) /
/// (columns, rows).
struct GridChart {
  int columns;
  int rows;
};

/// What was joined of a mesh file whose vertices lie at the same places: see toCage.
struct JoinedVertices {
  int vertices = 0;    ///< for which another one stands
  int apartEdges = 0;  ///< edges with ends in common that stay apart: more than two faces meet
                       ///< there, or two that run along it in the same direction
};

/// More parts are too many to report the shadows of each on each.
constexpr std::size_t mostParts = 8;

/// A control cage with face-varying texture coordinates: n = 4 corners a face for Catmull-Clark, 3
/// for Loop. Corner k of face f is `faceVertices[n f + k]` with uv `uvs[faceUvs[n f + k]]`. Corners
/// run counter-clockwise seen from outside; (s, t) of a quadrilateral is (0,0), (1,0), (1,1), (0,1)
/// at corners 0 to 3. uv is interpolated bilinearly inside a quadrilateral and linearly inside a
/// triangle, as a GPU does on a mesh of the same faces.
struct Cage {
  std::vector<Vec3> positions;
  std::vector<int> faceVertices;
  std::vector<Vec2> uvs;
  std::vector<int> faceUvs;
  std::vector<Crease> creases;
  std::vector<SharpVertex> sharpVertices;
  CageBorder border = CageBorder::edgesAndCorners;
  SubdivisionScheme scheme = SubdivisionScheme::catmullClark;
  std::optional<GridChart> grid;
  /// What its parts are called, and the part of every face; both empty for a cage of one part.
  std::vector<std::string> partNames;
  std::vector<int> faceParts;
  JoinedVertices joined;

  /// n: corners of a face.
  [[nodiscard]] std::size_t faceSize() const { return scheme == SubdivisionScheme::loop ? 3 : 4; }
  [[nodiscard]] int faceCount() const { return static_cast<int>(faceVertices.size() / faceSize()); }
  /// The part of every face of the limit surface of a cage that has parts, all of whose faces have
  /// one: three faces for each triangle of a Loop cage.
  [[nodiscard]] std::vector<int> limitFaceParts() const;
};

}  // namespace gnomon::surface
