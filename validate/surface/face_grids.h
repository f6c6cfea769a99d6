#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "surface/limit_surface.h"

namespace gnomon::surface {

/// Which grid lines cross one face: indices into a list of lines.
struct FaceLines {
  int s;  ///< parameters s of the columns of vertices
  int t;  ///< parameters t of the rows of vertices
};

/// The grid of vertices over one face. Columns follow s, rows follow t.
struct FaceGrid {
  std::uint32_t firstVertex;
  int columns;  ///< vertices along s, at least 2
  int rows;     ///< vertices along t, at least 2
  FaceLines lines;

  [[nodiscard]] std::size_t vertex(std::size_t column, std::size_t row) const {
    return firstVertex + row * static_cast<std::size_t>(columns) + column;
  }
  [[nodiscard]] std::size_t vertexCount() const {
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  }
  [[nodiscard]] std::size_t triangleCount() const {
    return 2 * static_cast<std::size_t>(columns - 1) * static_cast<std::size_t>(rows - 1);
  }
};

/// A grid of vertices over every face of a surface, which all meshes of a surface are made on.
/// Vertices are numbered face by face, and row by row within a face; faces that meet have vertices
/// of their own at the same places (see forEachSharedVertex).
class FaceGrids {
 public:
  /// @param lines  lists of rising parameters from 0 to 1, at least two each
  /// @param faces  one a face. Faces that share an edge have the same number of lines across it.
  FaceGrids(std::vector<std::vector<double>> lines, const std::vector<FaceLines>& faces);

  /// Every face cut into `pieces` × `pieces` equal squares of its parameters.
  static FaceGrids even(int faceCount, int pieces);

  [[nodiscard]] const std::vector<FaceGrid>& faces() const { return faces_; }
  [[nodiscard]] const std::vector<double>& sLines(const FaceGrid& grid) const {
    return lines_[static_cast<std::size_t>(grid.lines.s)];
  }
  [[nodiscard]] const std::vector<double>& tLines(const FaceGrid& grid) const {
    return lines_[static_cast<std::size_t>(grid.lines.t)];
  }
  /// All vertices. Beyond 2³² `FaceGrid::firstVertex` cannot number them.
  [[nodiscard]] std::size_t vertexCount() const { return vertexCount_; }
  [[nodiscard]] std::size_t triangleCount() const { return triangleCount_; }

 private:
  std::vector<std::vector<double>> lines_;
  std::vector<FaceGrid> faces_;
  std::size_t vertexCount_ = 0;
  std::size_t triangleCount_ = 0;
};

/// 0, 1 / pieces, … 1.
std::vector<double> evenLines(int pieces);

/// Visits every vertex on a face's border that an earlier face has too (on an edge between the same
/// two cage vertices, or at the same cage vertex), as `visit(first, vertex)`: `first` is the vertex
/// of the first face that has it, and is never visited as `vertex` itself. Copying the former to
/// the latter makes neighbours agree to the bit.
void forEachSharedVertex(const LimitSurface& surface, const FaceGrids& grids,
                         const std::function<void(std::size_t first, std::size_t vertex)>& visit);

/// For each vertex the first one at the same place: itself, or `first` of forEachSharedVertex.
std::vector<std::uint32_t> firstVertices(const LimitSurface& surface, const FaceGrids& grids);

/// Along which diagonal the quadrilaterals of a grid are cut into two triangles each.
enum class Diagonal {
  fromOrigin,    ///< from (0, 0) to (1, 1): meshes that are drawn
  acrossOrigin,  ///< from (1, 0) to (0, 1): as Embree cuts its grids, so what rays are traced on
};

/// Three vertices a triangle, counter-clockwise seen from outside; two triangles a quadrilateral,
/// row by row and face by face.
std::vector<std::uint32_t> gridTriangles(const FaceGrids& grids, Diagonal diagonal);

/// The size of one face on the map.
struct FaceTexels {
  double s;     ///< the longest line along s, texels
  double t;     ///< the longest line along t, texels
  double area;  ///< square texels
};

/// Texture coordinates are bilinear on a face, so that the longest line along s or t is an edge.
/// @param texelsPerUv  as in texelFrame
FaceTexels faceTexels(const LimitSurface& surface, Vec2 texelsPerUv, int face);

/// The longest edge of any face, texels.
double longestEdgeTexels(const LimitSurface& surface, Vec2 texelsPerUv);

}  // namespace gnomon::surface
