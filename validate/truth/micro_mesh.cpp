#include "truth/micro_mesh.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "common/counted_progress.h"
#include "common/error.h"
#include "common/parallel.h"
#include "common/system/memory.h"
#include "surface/limit_face.h"
#include "surface/shared_vertices.h"
#include "surface/texel_frame.h"

namespace gnomon {
namespace {

// Measured on Embree 3.13: what its grid hierarchy takes beside the vertices.
constexpr double hierarchyBytesPerQuad = 18;
constexpr double bytesPerVertex = 12;
/// The cell of rising lines from 0 to 1 that holds a place: lines[k] <= at < lines[k + 1], or the
/// nearest to that. Lines are about evenly spaced: the guess is right or a few cells off.
std::size_t cellOf(const std::vector<double>& lines, double at) {
  const std::size_t last = lines.size() - 2;
  const double guess = at > 0 ? std::min(at, 1.0) * static_cast<double>(last) : 0.0;
  auto k = static_cast<std::size_t>(guess);
  while (k > 0 && lines[k] > at) --k;
  while (k < last && lines[k + 1] <= at) ++k;
  return k;
}

/// Some rows of a face's grid: what one thread computes at once.
struct RowBlock {
  std::size_t face, firstRow, endRow;
};

/// All rows of all faces, so cut that even a single face keeps every thread busy.
std::vector<RowBlock> rowBlocks(const std::vector<MicroMesh::Grid>& grids) {
  constexpr std::size_t mostRows = 32;
  std::vector<RowBlock> blocks;
  for (std::size_t face = 0; face < grids.size(); ++face) {
    const auto rows = static_cast<std::size_t>(grids[face].rows);
    for (std::size_t row = 0; row < rows; row += mostRows) {
      blocks.push_back({face, row, std::min(row + mostRows, rows)});
    }
  }
  return blocks;
}

Vec3 cageCentre(const LimitSurface& surface) {
  Vec3 low(std::numeric_limits<double>::infinity());
  Vec3 high = -low;
  for (int face = 0; face < surface.faceCount(); ++face) {
    const Vec3 position = surface.evaluate(face, 0.5, 0.5).position;
    low = glm::min(low, position);
    high = glm::max(high, position);
  }
  return (low + high) / 2.0;
}

}  // namespace

MicroMesh::MicroMesh(const LimitSurface& surface, const Relief& relief,
                     const MicroMeshSettings& settings, const Progress& progress)
    : lines_(placeMicroLines(surface, relief.texelsPerUv(), settings,
                             bytesPerVertex + hierarchyBytesPerQuad)) {
  makeGrids();
  centre_ = cageCentre(surface);
  displace(surface, relief, progress);
  weld(surface);
  measureExtent();
}

void MicroMesh::makeGrids() {
  std::uint64_t vertices = 0;
  for (const MicroLines::Face& face : lines_.faces) {
    Grid grid{};
    grid.sLines = face.s;
    grid.tLines = face.t;
    grid.columns = static_cast<int>(lines(grid.sLines).size());
    grid.rows = static_cast<int>(lines(grid.tLines).size());
    grid.firstVertex = static_cast<std::uint32_t>(vertices);
    const auto columns = static_cast<std::uint64_t>(grid.columns);
    const auto rows = static_cast<std::uint64_t>(grid.rows);
    vertices += columns * rows;
    triangleCount_ += 2 * (columns - 1) * (rows - 1);
    grids_.push_back(grid);
  }
  if (vertices > std::numeric_limits<std::uint32_t>::max()) {
    throw InputError(fmt::format("truth.step = {}: {} micro-vertices, at most 2^32 can be numbered",
                                 askedStepTexels(), vertices));
  }
  requireMemory(static_cast<double>(vertices) * (bytesPerVertex + hierarchyBytesPerQuad),
                fmt::format("truth.step = {}: a micro-mesh of {:.3g} triangles", askedStepTexels(),
                            static_cast<double>(triangleCount_)));
  vertexCount_ = static_cast<std::size_t>(vertices);
  // One float of padding: Embree reads vertices as four floats.
  coordinates_.resize(3 * vertexCount_ + 1);
  coordinates_[3 * vertexCount_] = 0;
}

void MicroMesh::displace(const LimitSurface& surface, const Relief& relief,
                         const Progress& progress) {
  const Vec2 texelsPerUv = relief.texelsPerUv();
  const std::vector<RowBlock> blocks = rowBlocks(grids_);
  CountedProgress done(progress, blocks.size());
  parallelFor(0, blocks.size(), [&](std::size_t b) {
    const RowBlock& block = blocks[b];
    const Grid& grid = grids_[block.face];
    const std::vector<double>& s = lines(grid.sLines);
    const std::vector<double>& t = lines(grid.tLines);
    const LimitFace face(surface, static_cast<int>(block.face),
                         (block.endRow - block.firstRow) * s.size());
    std::vector<TangentPoint> points(s.size());
    float* out = &coordinates_[3 * (grid.firstVertex + block.firstRow * s.size())];
    for (std::size_t row = block.firstRow; row < block.endRow; ++row) {
      face.row(t[row], s, points);
      for (const TangentPoint& point : points) {
        const Vec3 position = displaced(relief, texelFrame(point, texelsPerUv)) - centre_;
        for (int axis = 0; axis < 3; ++axis) *out++ = static_cast<float>(position[axis]);
      }
    }
    done.advance();
  });
}

void MicroMesh::weld(const LimitSurface& surface) {
  forEachSharedVertex(
      surface,
      [this](std::size_t face) {
        const Grid& grid = grids_[face];
        return FaceGrid{grid.firstVertex, grid.columns, grid.rows};
      },
      [this](std::size_t first, std::size_t vertex) {
        std::copy_n(&coordinates_[3 * first], 3, &coordinates_[3 * vertex]);
      });
}

void MicroMesh::measureExtent() {
  constexpr std::size_t piece = 1 << 16;
  const std::span<const float> all = coordinates().first(3 * vertexCount_);
  std::vector<float> largest((all.size() + piece - 1) / piece, 0.0F);
  parallelFor(0, largest.size(), [&](std::size_t k) {
    // Side by side, so that the compiler may use vectors: it must not change the order of a
    // maximum.
    std::array<float, 16> lanes{};
    const auto part = all.subspan(k * piece, std::min(piece, all.size() - k * piece));
    const std::size_t whole = part.size() - part.size() % lanes.size();
    for (std::size_t i = 0; i < whole; i += lanes.size()) {
      for (std::size_t l = 0; l < lanes.size(); ++l) {
        lanes[l] = std::max(lanes[l], std::abs(part[i + l]));
      }
    }
    for (const float rest : part.subspan(whole)) lanes[0] = std::max(lanes[0], std::abs(rest));
    largest[k] = *std::max_element(lanes.begin(), lanes.end());
  });
  extent_ = *std::max_element(largest.begin(), largest.end());
}

Vec3 MicroMesh::vertex(std::size_t index) const {
  return {coordinates_[3 * index], coordinates_[3 * index + 1], coordinates_[3 * index + 2]};
}

Facet MicroMesh::facet(int face, double s, double t) const {
  const Grid& grid = grids_[static_cast<std::size_t>(face)];
  const auto cell = [](const std::vector<double>& lines, double at) {
    const std::size_t k = cellOf(lines, at);
    return std::pair{k, std::clamp((at - lines[k]) / (lines[k + 1] - lines[k]), 0.0, 1.0)};
  };
  const auto [column, a] = cell(lines(grid.sLines), s);
  const auto [row, b] = cell(lines(grid.tLines), t);
  const auto stride = static_cast<std::size_t>(grid.columns);
  const std::size_t first = grid.firstVertex + row * stride + column;
  // Embree cuts a grid's cell along the diagonal from (1, 0) to (0, 1).
  const Vec3 v10 = vertex(first + 1);
  const Vec3 v01 = vertex(first + stride);
  const bool lower = a + b <= 1;
  const Vec3 corner = vertex(lower ? first : first + stride + 1);
  const Vec3 alongS = lower ? v10 - corner : v01 - corner;
  const Vec3 alongT = lower ? v01 - corner : v10 - corner;
  const Vec3 normal = glm::cross(alongS, alongT);
  const double area = glm::length(normal);
  return {corner + (lower ? a : 1 - a) * alongS + (lower ? b : 1 - b) * alongT,
          area > 0 ? normal / area : Vec3(0)};
}

}  // namespace gnomon
