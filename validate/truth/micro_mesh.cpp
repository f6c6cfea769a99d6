#include "truth/micro_mesh.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "common/error.h"
#include "common/parallel.h"
#include "common/system/memory.h"
#include "displaced/displaced_mesh.h"
#include "surface/closed_surface.h"

namespace gnomon::truth {

namespace {

// Embree stores a grid's sides in 16 bits.
constexpr std::size_t longestSide = 32767;

/// Refuses a face that needs more lines than a grid can have.
void requireSide(double lines, double step) {
  if (!(lines < static_cast<double>(longestSide))) {
    throw InputError(
        fmt::format("{} texels make {:.0f} lines across one face, at most {} are possible: use a "
                    "cage of more faces, or fewer repeats",
                    step, lines, longestSide),
        "step");
  }
}

/// Lines across a face, and the longest of the pieces between them.
struct Lines {
  std::vector<double> parameters;
  double longestTexels = 0;
};

/// Rising parameters in [0, 1]: the places of texel centres where the axis runs from texel `begin`
/// to `end`, and between them even steps of at most `step` texels.
Lines alignedLines(double begin, double end, double step) {
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
  Lines lines{{0}};
  for (std::size_t k = 1; k < stops.size(); ++k) {
    const double gap = stops[k] - stops[k - 1];
    const int pieces = std::max(1, static_cast<int>(std::ceil(gap / step - 1e-6)));
    for (int p = 1; p <= pieces; ++p) {
      lines.parameters.push_back((stops[k - 1] - begin + gap * p / pieces) / length);
    }
    lines.longestTexels = std::max(lines.longestTexels, gap / pieces);
  }
  lines.parameters.back() = 1;
  requireSide(static_cast<double>(lines.parameters.size()), step);  // rounding up may have added
  return lines;
}

/// Faces that form a regular grid with affine texture coordinates.
class Chart {
 public:
  Chart(const surface::GridChart& grid, Vec2 texelsPerUv)
      : grid_(grid), side_(texelsPerUv / Vec2(grid.columns, grid.rows)) {}

  /// Without placing a line: an estimate, since lines of texel centres are added.
  [[nodiscard]] double triangles(double step) const {
    const double longest = std::min(step, 1.0);  // lines of texel centres are one texel apart
    const Vec2 pieces = glm::ceil(side_ / longest);
    return 2 * pieces.x * grid_.columns * pieces.y * grid_.rows;
  }

  void place(MicroLines& result, double step) const {
    const auto add = [&](double begin, double end) {
      Lines lines = alignedLines(begin, end, step);
      result.longestTexels = std::max(result.longestTexels, lines.longestTexels);
      result.lines.push_back(std::move(lines.parameters));
    };
    for (int c = 0; c < grid_.columns; ++c) add(c * side_.x, (c + 1) * side_.x);
    for (int r = 0; r < grid_.rows; ++r) add(r * side_.y, (r + 1) * side_.y);
    for (int face = 0; face < grid_.columns * grid_.rows; ++face) {
      result.faces.push_back({face % grid_.columns, grid_.columns + face / grid_.columns});
    }
  }

 private:
  surface::GridChart grid_;
  Vec2 side_;  ///< of a face, texels
};

/// Faces that form no such grid.
class Rings {
 public:
  Rings(const surface::LimitSurface& surface, Vec2 texelsPerUv)
      : rings_(surface::makeEdgeRings(surface)),
        texels_(static_cast<std::size_t>(rings_.count), 0.0) {
    std::vector<surface::FaceTexels> sizes(rings_.faces.size());
    parallelFor(0, sizes.size(), [&](std::size_t face) {
      sizes[face] = surface::faceTexels(surface, texelsPerUv, static_cast<int>(face));
    });
    double area = 0;
    int withArea = 0;
    for (std::size_t face = 0; face < sizes.size(); ++face) {
      const surface::FaceTexels& size = sizes[face];
      double& s = texels_[static_cast<std::size_t>(rings_.faces[face].s)];
      s = std::max(s, size.s);
      double& t = texels_[static_cast<std::size_t>(rings_.faces[face].t)];
      t = std::max(t, size.t);
      area += size.area;
      withArea += size.area > 0 ? 1 : 0;
    }
    if (withArea > 0) averageSide_ = std::sqrt(area / withArea);
  }

  [[nodiscard]] double triangles(double step) const {
    double quads = 0;
    for (const surface::EdgeRings::Face& face : rings_.faces)
      quads += pieces(face.s, step) * pieces(face.t, step);
    return 2 * quads;
  }

  void place(MicroLines& result, double step) const {
    std::map<int, int> linesOf;  // by their number of pieces
    std::vector<int> ofRing;
    for (int ring = 0; ring < rings_.count; ++ring) {
      requireSide(pieces(ring, step), step);
      const int count = static_cast<int>(pieces(ring, step));
      const auto [entry, isNew] = linesOf.try_emplace(count, static_cast<int>(result.lines.size()));
      if (isNew) result.lines.push_back(surface::evenLines(count));
      ofRing.push_back(entry->second);
      result.longestTexels = std::max(result.longestTexels, texels(ring) / count);
    }
    for (const surface::EdgeRings::Face& face : rings_.faces) {
      result.faces.push_back(
          {ofRing[static_cast<std::size_t>(face.s)], ofRing[static_cast<std::size_t>(face.t)]});
    }
  }

 private:
  [[nodiscard]] double texels(int ring) const { return texels_[static_cast<std::size_t>(ring)]; }
  [[nodiscard]] double pieces(int ring, double step) const {
    constexpr double rounding = 1e-9;
    const double length = std::max(texels(ring), averageSide_ / 4);
    return std::max(1.0, std::ceil(length / step - rounding));
  }

  surface::EdgeRings rings_;
  std::vector<double> texels_;  ///< the longest edge of each ring
  double averageSide_ = 0;      ///< of a face, if all with an area were squares of one size
};

/// The largest 1/4, 1/8, 1/12 … of a texel that gives enough triangles: a smaller step never gives
/// fewer.
template <typename Faces>
double chooseStep(const Faces& faces, const MicroMeshSettings& settings) {
  if (settings.stepTexels) return *settings.stepTexels;
  constexpr int finest = 1 << 16;  // where one texel holds a whole face, and more
  const auto stepOf = [](int quarters) { return 1.0 / (4 * quarters); };
  int few = 0;  // quarters that give too few
  int enough = finest / 4;
  const auto isEnough = [&](int quarters) {
    return faces.triangles(stepOf(quarters)) >= settings.leastTriangles;
  };
  if (!isEnough(enough)) {
    throw InputError(
        fmt::format("pieces of 1/{} texel do not give {:g} micro-triangles: the surface or its "
                    "texture coordinates have no area, or too few texels lie on it. More repeats "
                    "of the map, other texture coordinates, or a step expected",
                    finest, settings.leastTriangles),
        "step");
  }
  while (enough - few > 1) {
    const int middle = (few + enough) / 2;
    (isEnough(middle) ? enough : few) = middle;
  }
  return stepOf(enough);
}

template <typename Faces>
MicroLines place(const Faces& faces, const MicroMeshSettings& settings, double bytesPerQuad) {
  MicroLines result;
  result.askedTexels = chooseStep(faces, settings);
  const double step = result.askedTexels;
  if (!(step > 0) || !std::isfinite(step)) {
    throw InputError(fmt::format("{} texels found, a positive length expected", step), "step");
  }
  const double triangles = faces.triangles(step);
  requireMemory(triangles / 2 * bytesPerQuad,
                fmt::format("{} texels make a micro-mesh of {:.3g} triangles", step, triangles),
                "step");
  faces.place(result, step);
  return result;
}

}  // namespace

MicroLines placeMicroLines(const surface::LimitSurface& surface, Vec2 texelsPerUv,
                           const MicroMeshSettings& settings, double bytesPerQuad) {
  if (const auto grid = surface.grid()) {
    return place(Chart(*grid, texelsPerUv), settings, bytesPerQuad);
  }
  return place(Rings(surface, texelsPerUv), settings, bytesPerQuad);
}

namespace {

// Measured on Embree 3.13: what its grid hierarchy takes apart from the vertices.
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

// A step whose part across a line is less than this share of it runs along the line.
constexpr double alongLine = 1e-5;

/// A parameter's place among the lines of a grid.
struct LinePlace {
  std::size_t cell;
  double share;  ///< of the cell, from its first line
  double width;  ///< of the cell
};

/// A place on a line, within parameterRounding, counts to the cell after it where the step from it
/// goes forward, else to the one before.
LinePlace linePlace(const std::vector<double>& lines, double at, bool forward) {
  std::size_t cell = cellOf(lines, at);
  if (forward) {
    if (cell + 2 < lines.size() && at > lines[cell + 1] - parameterRounding) ++cell;
  } else {
    if (cell > 0 && at < lines[cell] + parameterRounding) --cell;
  }
  const double width = lines[cell + 1] - lines[cell];
  return {cell, std::clamp((at - lines[cell]) / width, 0.0, 1.0), width};
}

/// Whether a place lies in the triangle at the cell's first corner: a + b < 1. On the diagonal,
/// within parameterRounding, it does where the step from it leads there.
bool isLower(const LinePlace& a, const LinePlace& b, const Vec2& step) {
  const double beyond = a.share + b.share - 1;
  const double rounding = parameterRounding * (1 / a.width + 1 / b.width);
  if (std::abs(beyond) > rounding) return beyond < 0;
  const Vec2 inCells(step.x / a.width, step.y / b.width);
  return inCells.x + inCells.y < -alongLine * glm::length(inCells);
}

Vec3 cageCentre(const surface::LimitSurface& surface) {
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

MicroMesh::MicroMesh(const surface::LimitSurface& surface, const relief::Relief& relief,
                     const MicroMeshSettings& settings, const Progress& progress)
    : MicroMesh(placeMicroLines(surface, relief.texelsPerUv(), settings,
                                bytesPerVertex + hierarchyBytesPerQuad),
                surface, relief, progress) {}

MicroMesh::MicroMesh(MicroLines lines, const surface::LimitSurface& surface,
                     const relief::Relief& relief, const Progress& progress)
    : askedTexels_(lines.askedTexels),
      longestTexels_(lines.longestTexels),
      grids_(std::move(lines.lines), lines.faces) {
  reserve();
  centre_ = cageCentre(surface);
  displace(surface, relief, progress);
  weld(surface);
  measureExtent();
}

void MicroMesh::reserve() {
  if (vertexCount() > std::numeric_limits<std::uint32_t>::max()) {
    throw InputError(fmt::format("{} texels make {} micro-vertices, at most 2^32 can be numbered",
                                 askedTexels_, vertexCount()),
                     "step");
  }
  requireMemory(static_cast<double>(vertexCount()) * (bytesPerVertex + hierarchyBytesPerQuad),
                fmt::format("{} texels make a micro-mesh of {:.3g} triangles", askedTexels_,
                            static_cast<double>(triangleCount())),
                "step");
  // One float of padding: Embree reads vertices as four floats.
  coordinates_.resize(3 * vertexCount() + 1);
  coordinates_[3 * vertexCount()] = 0;
}

void MicroMesh::displace(const surface::LimitSurface& surface, const relief::Relief& relief,
                         const Progress& progress) {
  const auto store = [this](std::size_t first, std::span<const Vec3> points) {
    float* out = &coordinates_[3 * first];
    for (const Vec3& point : points) {
      const Vec3 position = point - centre_;
      for (int axis = 0; axis < 3; ++axis) *out++ = static_cast<float>(position[axis]);
    }
  };
  displaced::displaceGrids(surface, relief, grids_, store, progress);
}

void MicroMesh::weld(const surface::LimitSurface& surface) {
  surface::forEachSharedVertex(surface, grids_, [this](std::size_t first, std::size_t vertex) {
    std::copy_n(&coordinates_[3 * first], 3, &coordinates_[3 * vertex]);
  });
}

void MicroMesh::measureExtent() {
  constexpr std::size_t piece = 1 << 16;
  const std::span<const float> all = coordinates().first(3 * vertexCount());
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

Facet MicroMesh::facet(int face, double s, double t, const Vec2& toward) const {
  const surface::FaceGrid& grid = grids_.faces()[static_cast<std::size_t>(face)];
  const double none = -alongLine * glm::length(toward);
  const LinePlace a = linePlace(grids_.sLines(grid), s, toward.x >= none);
  const LinePlace b = linePlace(grids_.tLines(grid), t, toward.y >= none);
  // Embree cuts a grid's cell as Diagonal::acrossOrigin does.
  const Vec3 v10 = vertex(grid.vertex(a.cell + 1, b.cell));
  const Vec3 v01 = vertex(grid.vertex(a.cell, b.cell + 1));
  const bool lower = isLower(a, b, toward);
  const Vec3 corner =
      vertex(lower ? grid.vertex(a.cell, b.cell) : grid.vertex(a.cell + 1, b.cell + 1));
  const Vec3 alongS = lower ? v10 - corner : v01 - corner;
  const Vec3 alongT = lower ? v01 - corner : v10 - corner;
  const Vec3 normal = glm::cross(alongS, alongT);
  const double area = glm::length(normal);
  return {
      corner + (lower ? a.share : 1 - a.share) * alongS + (lower ? b.share : 1 - b.share) * alongT,
      area > 0 ? normal / area : Vec3(0)};
}

surface::SurfaceSample MicroMesh::parametersAt(int face, const Vec2& place) const {
  const surface::FaceGrid& grid = grids_.faces()[static_cast<std::size_t>(face)];
  const auto parameter = [](const std::vector<double>& lines, double share) {
    const double at = std::clamp(share, 0.0, 1.0) * static_cast<double>(lines.size() - 1);
    const std::size_t k = std::min(static_cast<std::size_t>(at), lines.size() - 2);
    return static_cast<float>(std::lerp(lines[k], lines[k + 1], at - static_cast<double>(k)));
  };
  return {face, parameter(grids_.sLines(grid), place.x), parameter(grids_.tLines(grid), place.y)};
}

}  // namespace gnomon::truth
