#include "truth/micro_mesh.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "common/counted_progress.h"
#include "common/error.h"
#include "common/memory.h"
#include "common/parallel.h"
#include "surface/limit_face.h"
#include "surface/shared_vertices.h"
#include "surface/texel_frame.h"

namespace gnomon {
namespace {

// Measured on Embree 3.13: what its grid hierarchy takes beside the vertices.
constexpr double hierarchyBytesPerQuad = 18;
constexpr double bytesPerVertex = 12;
// Embree stores a grid's sides in 16 bits.
constexpr std::size_t longestSide = 32767;

/// Refuses a face that needs more lines than a grid can have.
void requireSide(double lines, double step) {
  if (!(lines < static_cast<double>(longestSide))) {
    throw InputError(
        fmt::format("truth.step = {}: {:.0f} lines across one face, at most {} are possible: use a "
                    "cage of more faces, or fewer repeats",
                    step, lines, longestSide));
  }
}

/// Rising parameters in [0, 1]: the places of texel centres where the axis runs from texel `begin`
/// to `end`, and between them even steps of at most `step` texels.
std::vector<double> alignedLines(double begin, double end, double step) {
  const double length = end - begin;
  requireSide(length / std::min(step, 1.0), step);
  const double tolerance = 1e-9 * std::max(1.0, std::abs(end));
  std::vector<double> stops = {begin};
  const auto centres = static_cast<int>(std::ceil(end - std::floor(begin)));
  for (int k = 0; k < centres; ++k) {
    const double centre = std::floor(begin) + 0.5 + k;
    if (centre > begin + tolerance && centre < end - tolerance) stops.push_back(centre);
  }
  stops.push_back(end);
  std::vector<double> lines = {0};
  for (std::size_t k = 1; k < stops.size(); ++k) {
    const double gap = stops[k] - stops[k - 1];
    const int pieces = std::max(1, static_cast<int>(std::ceil(gap / step - 1e-6)));
    for (int p = 1; p <= pieces; ++p) {
      lines.push_back((stops[k - 1] - begin + gap * p / pieces) / length);
    }
  }
  lines.back() = 1;
  requireSide(static_cast<double>(lines.size()), step);  // rounding up may have added some
  return lines;
}

std::vector<double> evenLines(int pieces) {
  std::vector<double> lines(static_cast<std::size_t>(pieces) + 1);
  for (int i = 0; i <= pieces; ++i) lines[static_cast<std::size_t>(i)] = double(i) / pieces;
  return lines;
}

double texelArea(const LimitSurface& surface, Vec2 texelsPerUv, int face) {
  const LimitPoint middle = surface.evaluate(face, 0.5, 0.5);
  const Vec2 ds = middle.uvDs * texelsPerUv;
  const Vec2 dt = middle.uvDt * texelsPerUv;
  return std::abs(ds.x * dt.y - ds.y * dt.x);
}

/// The side of a face in texels if all faces with an area there were squares of its mean.
double meanFaceSide(const LimitSurface& surface, Vec2 texelsPerUv) {
  double sum = 0;
  int faces = 0;
  for (int face = 0; face < surface.faceCount(); ++face) {
    const double area = texelArea(surface, texelsPerUv, face);
    sum += area;
    faces += area > 0 ? 1 : 0;
  }
  return faces > 0 ? std::sqrt(sum / faces) : 0;
}

/// Triangles that a step gives, without placing a line.
/// @param faceSide  meanFaceSide; only where the faces form no grid
double estimatedTriangles(const LimitSurface& surface, Vec2 texelsPerUv, double faceSide,
                          double step) {
  if (const auto grid = surface.grid()) {
    const double longest = std::min(step, 1.0);  // lines of texel centres are one texel apart
    const double perColumn = std::ceil(texelsPerUv.x / grid->columns / longest);
    const double perRow = std::ceil(texelsPerUv.y / grid->rows / longest);
    return 2 * perColumn * grid->columns * perRow * grid->rows;
  }
  const double pieces = std::ceil(faceSide / step);
  return 2 * pieces * pieces * surface.faceCount();
}

double chooseStep(const LimitSurface& surface, Vec2 texelsPerUv, double faceSide,
                  const MicroMeshSettings& settings) {
  if (settings.stepTexels) return *settings.stepTexels;
  constexpr int finest = 1 << 16;  // where one texel holds a whole face, and more
  for (int perTexel = 4; perTexel <= finest; perTexel += 4) {
    const double step = 1.0 / perTexel;
    if (estimatedTriangles(surface, texelsPerUv, faceSide, step) >= settings.leastTriangles) {
      return step;
    }
  }
  throw InputError(fmt::format(
      "truth.step: pieces of 1/{} texel do not give {:g} micro-triangles: the surface or its "
      "texture coordinates have no area, or too few texels lie on it. More relief.repeats, other "
      "texture coordinates, or a truth.step expected",
      finest, settings.leastTriangles));
}

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
                     const MicroMeshSettings& settings, const Progress& progress) {
  const Vec2 texelsPerUv = relief.texelsPerUv();
  const double faceSide = surface.grid() ? 0 : meanFaceSide(surface, texelsPerUv);
  stepTexels_ = chooseStep(surface, texelsPerUv, faceSide, settings);
  if (!(stepTexels_ > 0) || !std::isfinite(stepTexels_)) {
    throw InputError(
        fmt::format("truth.step: {} texels found, a positive length expected", stepTexels_));
  }
  const double quads = estimatedTriangles(surface, texelsPerUv, faceSide, stepTexels_) / 2;
  requireMemory(
      quads * (bytesPerVertex + hierarchyBytesPerQuad),
      fmt::format("truth.step = {}: a micro-mesh of {:.3g} triangles", stepTexels_, 2 * quads));
  placeLines(surface, texelsPerUv, stepTexels_);
  centre_ = cageCentre(surface);
  displace(surface, relief, progress);
  weld(surface);
  measureExtent();
}

void MicroMesh::placeLines(const LimitSurface& surface, Vec2 texelsPerUv, double step) {
  const auto chart = surface.grid();
  if (chart) {
    const Vec2 side = texelsPerUv / Vec2(chart->columns, chart->rows);
    for (int c = 0; c < chart->columns; ++c) {
      lines_.push_back(alignedLines(c * side.x, (c + 1) * side.x, step));
    }
    for (int r = 0; r < chart->rows; ++r) {
      lines_.push_back(alignedLines(r * side.y, (r + 1) * side.y, step));
    }
  } else {
    const double pieces = std::ceil(meanFaceSide(surface, texelsPerUv) / step);
    requireSide(pieces, step);
    lines_.push_back(evenLines(std::max(1, static_cast<int>(pieces))));
  }
  std::uint64_t vertices = 0;
  for (int face = 0; face < surface.faceCount(); ++face) {
    Grid grid{};
    grid.sLines = chart ? face % chart->columns : 0;
    grid.tLines = chart ? chart->columns + face / chart->columns : 0;
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
                                 step, vertices));
  }
  requireMemory(static_cast<double>(vertices) * (bytesPerVertex + hierarchyBytesPerQuad),
                fmt::format("truth.step = {}: a micro-mesh of {:.3g} triangles", step,
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
