#include "displaced/displaced_mesh.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "common/parallel.h"
#include "common/progress.h"
#include "common/system/memory.h"
#include "surface/face_grids.h"
#include "surface/limit_surface.h"
#include "surface/texel_frame.h"

namespace gnomon::displaced {

namespace {

/// One side of a triangle: its ends by the number that coinciding vertices share, the lower first.
struct Side {
  std::uint32_t low, high;
  std::uint32_t triangle;
  std::uint32_t corner;  ///< the side runs from this corner to the next

  friend bool operator<(const Side& a, const Side& b) {
    return std::pair(a.low, a.high) < std::pair(b.low, b.high);
  }
  [[nodiscard]] bool meets(const Side& other) const {
    return low == other.low && high == other.high;
  }
};

std::vector<Side> sortedSides(const surface::BaseMesh& mesh,
                              const std::vector<std::uint32_t>& shared) {
  std::vector<Side> sides;
  sides.reserve(mesh.triangles.size());
  for (std::uint32_t triangle = 0; triangle < mesh.triangleCount(); ++triangle) {
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t a = shared[mesh.triangles[3 * triangle + corner]];
      const std::uint32_t b = shared[mesh.triangles[3 * triangle + (corner + 1) % 3]];
      sides.push_back({std::min(a, b), std::max(a, b), triangle, corner});
    }
  }
  std::sort(sides.begin(), sides.end());
  return sides;
}

}  // namespace

std::vector<std::uint32_t> triangleAdjacency(const surface::BaseMesh& mesh,
                                             const std::vector<std::uint32_t>& shared) {
  std::vector<std::uint32_t> adjacency(2 * mesh.triangles.size());
  const auto opposite = [&mesh](const Side& side) {
    return mesh.triangles[3 * side.triangle + (side.corner + 2) % 3];
  };
  const auto put = [&](const Side& side, std::uint32_t vertex) {
    adjacency[6 * side.triangle + 2 * side.corner] =
        mesh.triangles[3 * side.triangle + side.corner];
    adjacency[6 * side.triangle + 2 * side.corner + 1] = vertex;
  };
  const std::vector<Side> sides = sortedSides(mesh, shared);
  for (std::size_t i = 0; i < sides.size();) {
    // The cage has at most two faces an edge, so that an edge has one or two sides; where more
    // polygons meet, they pair as they come.
    const bool pair = i + 1 < sides.size() && sides[i].meets(sides[i + 1]);
    put(sides[i], opposite(sides[pair ? i + 1 : i]));
    if (pair) put(sides[i + 1], opposite(sides[i]));
    i += pair ? 2 : 1;
  }
  return adjacency;
}

DisplacedMesh makeDisplacedMesh(const surface::LimitSurface& surface, const relief::Relief& relief,
                                int subdivisions) {
  DisplacedMesh result;
  result.mesh = surface::makeBaseMesh(surface, relief.texelsPerUv(), subdivisions);
  surface::BaseMesh& mesh = result.mesh;
  requireMemory(static_cast<double>(mesh.triangles.size()) * (sizeof(Side) + 12),
                fmt::format("a displaced mesh of {} triangles", mesh.triangleCount()));
  parallelFor(0, mesh.vertices.size(), [&](std::size_t i) {
    surface::TexelFrame& frame = mesh.vertices[i].frame;
    frame.position = relief::displaced(relief, frame);
  });
  const auto shared =
      surface::firstVertices(surface, surface::FaceGrids::even(surface.faceCount(), subdivisions));
  for (std::size_t i = 0; i < shared.size(); ++i) {
    mesh.vertices[i].frame.position = mesh.vertices[shared[i]].frame.position;
  }
  result.adjacency = triangleAdjacency(mesh, shared);
  return result;
}

namespace {

/// Some rows of a face's grid: what one thread computes at once.
struct RowBlock {
  std::size_t face, firstRow, endRow;
};

/// All rows of all faces, so cut that even a single face keeps every thread busy.
std::vector<RowBlock> rowBlocks(const surface::FaceGrids& grids) {
  constexpr std::size_t mostRows = 32;
  std::vector<RowBlock> blocks;
  for (std::size_t face = 0; face < grids.faces().size(); ++face) {
    const auto rows = static_cast<std::size_t>(grids.faces()[face].rows);
    for (std::size_t row = 0; row < rows; row += mostRows) {
      blocks.push_back({face, row, std::min(row + mostRows, rows)});
    }
  }
  return blocks;
}

}  // namespace

void displaceGrids(const surface::LimitSurface& surface, const relief::Relief& relief,
                   const surface::FaceGrids& grids, const PointSink& sink,
                   const Progress& progress) {
  const Vec2 texelsPerUv = relief.texelsPerUv();
  const std::vector<RowBlock> blocks = rowBlocks(grids);
  CountedProgress done(progress, blocks.size());
  parallelFor(0, blocks.size(), [&](std::size_t b) {
    const RowBlock& block = blocks[b];
    const surface::FaceGrid& grid = grids.faces()[block.face];
    const std::vector<double>& s = grids.sLines(grid);
    const std::vector<double>& t = grids.tLines(grid);
    const surface::LimitFace face(surface, static_cast<int>(block.face),
                                  (block.endRow - block.firstRow) * s.size());
    std::vector<surface::TangentPoint> points(s.size());
    std::vector<Vec3> positions(s.size());
    for (std::size_t row = block.firstRow; row < block.endRow; ++row) {
      face.row(t[row], s, points);
      std::transform(points.begin(), points.end(), positions.begin(),
                     [&](const surface::TangentPoint& point) {
                       return relief::displaced(relief, surface::texelFrame(point, texelsPerUv));
                     });
      sink(grid.vertex(0, row), positions);
    }
    done.advance();
  });
}

}  // namespace gnomon::displaced
