#include "surface/shared_vertices.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

namespace gnomon {
namespace {

using GridOf = std::function<FaceGrid(std::size_t)>;
using Visit = std::function<void(std::size_t, std::size_t)>;

/// Vertex i of a grid's side k, from corner k to corner k + 1.
std::size_t sideVertex(const FaceGrid& grid, int side, int i) {
  const int lastColumn = grid.columns - 1;
  const int lastRow = grid.rows - 1;
  const std::array<std::pair<int, int>, 4> at = {std::pair{i, 0}, std::pair{lastColumn, i},
                                                 std::pair{lastColumn - i, lastRow},
                                                 std::pair{0, lastRow - i}};
  const auto [column, row] = at.at(static_cast<std::size_t>(side));
  return grid.firstVertex + static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) +
         static_cast<std::size_t>(column);
}

/// The sides without their ends.
void visitSides(const LimitSurface& surface, const GridOf& gridOf, const Visit& visit) {
  struct Side {
    std::size_t face;
    int side;
    int begin;  ///< its cage vertex
  };
  std::map<std::pair<int, int>, Side> firstSide;
  for (std::size_t face = 0; face < static_cast<std::size_t>(surface.faceCount()); ++face) {
    const std::array<int, 4> corners = surface.corners(static_cast<int>(face));
    const FaceGrid grid = gridOf(face);
    for (int side = 0; side < 4; ++side) {
      const int a = corners.at(static_cast<std::size_t>(side));
      const int b = corners.at(static_cast<std::size_t>((side + 1) % 4));
      const auto [entry, isFirst] = firstSide.try_emplace(std::minmax(a, b), Side{face, side, a});
      if (isFirst) continue;
      const Side& first = entry->second;
      const FaceGrid firstGrid = gridOf(first.face);
      const int length = side % 2 == 0 ? grid.columns : grid.rows;
      for (int i = 1; i + 1 < length; ++i) {
        visit(sideVertex(firstGrid, first.side, first.begin == a ? i : length - 1 - i),
              sideVertex(grid, side, i));
      }
    }
  }
}

void visitCorners(const LimitSurface& surface, const GridOf& gridOf, const Visit& visit) {
  std::vector<std::int64_t> firstCorner(static_cast<std::size_t>(surface.vertexCount()), -1);
  for (std::size_t face = 0; face < static_cast<std::size_t>(surface.faceCount()); ++face) {
    const std::array<int, 4> corners = surface.corners(static_cast<int>(face));
    for (int corner = 0; corner < 4; ++corner) {
      const auto cageVertex =
          static_cast<std::size_t>(corners.at(static_cast<std::size_t>(corner)));
      const std::size_t own = sideVertex(gridOf(face), corner, 0);
      if (firstCorner[cageVertex] < 0) {
        firstCorner[cageVertex] = static_cast<std::int64_t>(own);
      } else {
        visit(static_cast<std::size_t>(firstCorner[cageVertex]), own);
      }
    }
  }
}

}  // namespace

void forEachSharedVertex(const LimitSurface& surface, const GridOf& gridOf, const Visit& visit) {
  visitSides(surface, gridOf, visit);
  visitCorners(surface, gridOf, visit);
}

}  // namespace gnomon
