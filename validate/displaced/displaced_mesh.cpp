#include "displaced/displaced_mesh.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "common/error.h"
#include "common/parallel.h"
#include "common/system/memory.h"
#include "surface/closed_surface.h"
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

namespace {

constexpr int mostSubdivisions = 8192;

double triangleCount(const surface::LimitSurface& surface, int subdivisions) {
  return 2.0 * subdivisions * subdivisions * surface.faceCount();
}

/// Refuses a mesh that cannot be numbered or does not fit in memory, before anything of it is made.
void requireRoom(const surface::LimitSurface& surface, int subdivisions) {
  const std::string parameter = "subdivisions";
  if (subdivisions < 1 || subdivisions > mostSubdivisions) {
    throw InputError(fmt::format("{} found, 1 to {} expected", subdivisions, mostSubdivisions),
                     parameter);
  }
  const double vertices = (subdivisions + 1.0) * (subdivisions + 1.0) * surface.faceCount();
  if (!(vertices < std::numeric_limits<std::int32_t>::max())) {
    throw InputError(fmt::format("{} found, which give {:.3g} vertices: fewer than 2^31 expected",
                                 subdivisions, vertices),
                     parameter);
  }
  const double triangles = triangleCount(surface, subdivisions);
  constexpr double bytesPerVertex = 2 * sizeof(glm::vec3) + 2 * sizeof(std::uint32_t);
  constexpr double bytesPerTriangle = 3 * sizeof(std::uint32_t);
  requireMemory(vertices * bytesPerVertex + triangles * bytesPerTriangle,
                fmt::format("{}, a displaced mesh of {:.3g} triangles", subdivisions, triangles),
                parameter);
}

/// Leaves each vertex once: `first` becomes its number among those that `positions` then holds.
void weld(std::vector<glm::vec3>& positions, std::vector<std::uint32_t>& first) {
  std::uint32_t kept = 0;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    // The first of vertices at one place comes before the others.
    if (first[v] == v) {
      positions[kept] = positions[v];
      first[v] = kept++;
    } else {
      first[v] = first[first[v]];
    }
  }
  positions.resize(kept);
  positions.shrink_to_fit();
}

/// The least common multiple of whole numbers.
class CommonMultiple {
 public:
  /// Any number; one that is not whole leaves no multiple.
  void add(double number) {
    const double whole = std::round(number);
    if (std::abs(number - whole) > 1e-6 * whole || whole < 1 || multiple_ > mostSubdivisions) {
      multiple_ = none;
    } else {
      multiple_ = std::lcm(multiple_, static_cast<long>(whole));
    }
  }
  /// Infinite where there is none, or it is larger than any subdivisions.
  [[nodiscard]] double value() const {
    return multiple_ > mostSubdivisions ? std::numeric_limits<double>::infinity()
                                        : static_cast<double>(multiple_);
  }

 private:
  static constexpr long none = mostSubdivisions + 1;
  long multiple_ = 1;
};

}  // namespace

WeldedMesh makeWeldedMesh(const surface::LimitSurface& surface, const relief::Relief& relief,
                          int subdivisions) {
  requireRoom(surface, subdivisions);
  const surface::FaceGrids grids = surface::FaceGrids::even(surface.faceCount(), subdivisions);
  std::vector<glm::vec3> positions(grids.vertexCount());
  displaceGrids(surface, relief, grids, [&](std::size_t first, std::span<const Vec3> points) {
    std::copy(points.begin(), points.end(), positions.begin() + static_cast<std::ptrdiff_t>(first));
  });
  std::vector<std::uint32_t> numbers = surface::firstVertices(surface, grids);
  weld(positions, numbers);
  std::vector<std::uint32_t> triangles =
      surface::gridTriangles(grids, surface::Diagonal::acrossOrigin);
  for (std::uint32_t& vertex : triangles) vertex = numbers[vertex];
  return {std::move(positions), std::move(triangles), surface::isClosed(surface)};
}

Vec3 pointOn(const WeldedMesh& mesh, int subdivisions, int face, double s, double t) {
  const auto pieces = static_cast<std::size_t>(subdivisions);
  const auto cell = [&](double at) {
    const double scaled = at * subdivisions;
    const double piece = std::clamp(std::floor(scaled), 0.0, subdivisions - 1.0);
    return std::pair{static_cast<std::size_t>(piece), std::clamp(scaled - piece, 0.0, 1.0)};
  };
  const auto [column, a] = cell(s);
  const auto [row, b] = cell(t);
  const std::size_t quad = (static_cast<std::size_t>(face) * pieces + row) * pieces + column;
  const bool lower = a + b <= 1;
  // The corner, then the ends of the sides along s and t that the triangle has there.
  const std::size_t first = 6 * quad + (lower ? 0 : 3);
  const auto vertex = [&](std::size_t k) { return Vec3(mesh.vertices[mesh.triangles[first + k]]); };
  const Vec3 corner = vertex(0);
  return corner + (lower ? a : 1 - a) * (vertex(1) - corner) +
         (lower ? b : 1 - b) * (vertex(2) - corner);
}

int subdivisionsForTexels(const surface::LimitSurface& surface, Vec2 texelsPerUv,
                          double mostTriangles) {
  double longestSide = 0;
  CommonMultiple sides;
  for (int face = 0; face < surface.faceCount(); ++face) {
    const surface::LimitPoint middle = surface.evaluate(face, 0.5, 0.5);
    for (const Vec2& along : {middle.uvDs, middle.uvDt}) {
      const double side = glm::length(along * texelsPerUv);
      longestSide = std::max(longestSide, side);
      sides.add(side);
    }
  }
  const double most = std::sqrt(mostTriangles / triangleCount(surface, 1));
  const double line = 2 * sides.value();  // at its multiples pieces end on texel centres
  for (const int perTexel : {8, 4, 2, 1}) {
    const double pieces = line * std::ceil(perTexel * longestSide / line - 1e-9);
    if (pieces <= most && pieces >= line) return static_cast<int>(pieces);
  }
  return std::max(1, static_cast<int>(std::min(std::ceil(8 * longestSide - 1e-9), most)));
}

}  // namespace gnomon::displaced
