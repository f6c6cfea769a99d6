#include "truth/micro_lines.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "common/error.h"
#include "common/parallel.h"
#include "common/system/memory.h"
#include "surface/edge_rings.h"
#include "surface/face_texels.h"

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

}  // namespace gnomon::truth
