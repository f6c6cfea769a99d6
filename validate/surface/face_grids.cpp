#include "surface/face_grids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "surface/closed_surface.h"

namespace gnomon::surface {

namespace {

using Visit = std::function<void(std::size_t, std::size_t)>;

/// Vertex i of a grid's side k, from corner k to corner k + 1.
std::size_t sideVertex(const FaceGrid& grid, int side, int i) {
  const int lastColumn = grid.columns - 1;
  const int lastRow = grid.rows - 1;
  const std::array<std::pair<int, int>, 4> at = {std::pair{i, 0}, std::pair{lastColumn, i},
                                                 std::pair{lastColumn - i, lastRow},
                                                 std::pair{0, lastRow - i}};
  const auto [column, row] = at.at(static_cast<std::size_t>(side));
  return grid.vertex(static_cast<std::size_t>(column), static_cast<std::size_t>(row));
}

/// The sides without their ends.
void visitSides(const LimitSurface& surface, const FaceGrids& grids, const Visit& visit) {
  for (const auto& [first, second] : sharedSides(surface)) {
    const FaceGrid& own = grids.faces()[static_cast<std::size_t>(first.face)];
    const FaceGrid& other = grids.faces()[static_cast<std::size_t>(second.face)];
    const int last = (second.side % 2 == 0 ? other.columns : other.rows) - 1;
    for (int i = 1; i < last; ++i) {
      visit(sideVertex(own, first.side, last - i), sideVertex(other, second.side, i));
    }
  }
}

void visitCorners(const LimitSurface& surface, const FaceGrids& grids, const Visit& visit) {
  std::vector<std::int64_t> firstCorner(static_cast<std::size_t>(surface.vertexCount()), -1);
  for (std::size_t face = 0; face < grids.faces().size(); ++face) {
    const std::array<int, 4> corners = surface.corners(static_cast<int>(face));
    for (int corner = 0; corner < 4; ++corner) {
      std::int64_t& first =
          firstCorner[static_cast<std::size_t>(corners.at(static_cast<std::size_t>(corner)))];
      const std::size_t own = sideVertex(grids.faces()[face], corner, 0);
      if (first < 0) {
        first = static_cast<std::int64_t>(own);
      } else {
        visit(static_cast<std::size_t>(first), own);
      }
    }
  }
}

}  // namespace

FaceGrids::FaceGrids(std::vector<std::vector<double>> lines, const std::vector<FaceLines>& faces)
    : lines_(std::move(lines)) {
  faces_.reserve(faces.size());
  for (const FaceLines& face : faces) {
    const FaceGrid grid{static_cast<std::uint32_t>(vertexCount_),
                        static_cast<int>(lines_[static_cast<std::size_t>(face.s)].size()),
                        static_cast<int>(lines_[static_cast<std::size_t>(face.t)].size()), face};
    vertexCount_ += grid.vertexCount();
    triangleCount_ += grid.triangleCount();
    faces_.push_back(grid);
  }
}

FaceGrids FaceGrids::even(int faceCount, int pieces) {
  return {{evenLines(pieces)},
          std::vector<FaceLines>(static_cast<std::size_t>(faceCount), FaceLines{0, 0})};
}

std::vector<double> evenLines(int pieces) {
  std::vector<double> lines(static_cast<std::size_t>(pieces) + 1);
  for (int i = 0; i <= pieces; ++i) lines[static_cast<std::size_t>(i)] = double(i) / pieces;
  return lines;
}

void forEachSharedVertex(const LimitSurface& surface, const FaceGrids& grids, const Visit& visit) {
  visitSides(surface, grids, visit);
  visitCorners(surface, grids, visit);
}

std::vector<std::uint32_t> firstVertices(const LimitSurface& surface, const FaceGrids& grids) {
  std::vector<std::uint32_t> first(grids.vertexCount());
  std::iota(first.begin(), first.end(), 0U);
  forEachSharedVertex(surface, grids, [&](std::size_t earlier, std::size_t vertex) {
    first[vertex] = static_cast<std::uint32_t>(earlier);
  });
  return first;
}

std::vector<std::uint32_t> gridTriangles(const FaceGrids& grids, Diagonal diagonal) {
  std::vector<std::uint32_t> triangles;
  triangles.reserve(3 * grids.triangleCount());
  for (const FaceGrid& grid : grids.faces()) {
    const auto columns = static_cast<std::uint32_t>(grid.columns);
    for (std::uint32_t row = 0; row + 1 < static_cast<std::uint32_t>(grid.rows); ++row) {
      for (std::uint32_t column = 0; column + 1 < columns; ++column) {
        const std::uint32_t v00 = grid.firstVertex + row * columns + column;
        const std::uint32_t v10 = v00 + 1;
        const std::uint32_t v01 = v00 + columns;
        const std::uint32_t v11 = v01 + 1;
        if (diagonal == Diagonal::fromOrigin) {
          triangles.insert(triangles.end(), {v00, v10, v11, v00, v11, v01});
        } else {
          triangles.insert(triangles.end(), {v00, v10, v01, v11, v01, v10});
        }
      }
    }
  }
  return triangles;
}

FaceTexels faceTexels(const LimitSurface& surface, Vec2 texelsPerUv, int face) {
  const auto at = [&](double s, double t) {
    return surface.tangentPoint(face, s, t).uv * texelsPerUv;
  };
  const std::array corners = {at(0, 0), at(1, 0), at(1, 1), at(0, 1)};
  const auto edge = [&](std::size_t from, std::size_t to) {
    return glm::length(corners.at(to) - corners.at(from));
  };
  const Vec2 a = corners[2] - corners[0];
  const Vec2 b = corners[3] - corners[1];
  return {std::max(edge(0, 1), edge(3, 2)), std::max(edge(0, 3), edge(1, 2)),
          std::abs(a.x * b.y - a.y * b.x) / 2};
}

double longestEdgeTexels(const LimitSurface& surface, Vec2 texelsPerUv) {
  double longest = 0;
  for (int face = 0; face < surface.faceCount(); ++face) {
    const FaceTexels size = faceTexels(surface, texelsPerUv, face);
    longest = std::max({longest, size.s, size.t});
  }
  return longest;
}

}  // namespace gnomon::surface
