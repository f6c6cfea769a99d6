#include "relief/relief.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace gnomon::relief {

double worldPerHeight(HeightSpace space, const surface::TexelFrame& frame) {
  if (space == HeightSpace::world) return 1;
  return std::sqrt(glm::length(glm::cross(frame.px, frame.py)));
}

Vec3 displaced(const Relief& relief, const surface::TexelFrame& frame) {
  if (!frame.defined) return frame.position;
  const double height = worldPerHeight(relief.space, frame) * relief.field.at(frame.texel);
  return frame.position + height * frame.direction();
}

namespace {

/// Texture coordinates from files are rounded.
constexpr double rounding = 1e-6;

struct UvRange {
  Vec2 low{0}, high{1};
};

UvRange uvRange(const surface::Cage& cage) {
  // The outermost faces of a grid's cage reach past [0, 1] and have no limit surface.
  if (cage.grid || cage.uvs.empty()) return {};
  UvRange range{cage.uvs.front(), cage.uvs.front()};
  for (const Vec2& uv : cage.uvs) {
    range.low = glm::min(range.low, uv);
    range.high = glm::max(range.high, uv);
  }
  return range;
}

/// Whether a map lies at most once over an axis of texture coordinates.
bool isLaidOnce(const UvRange& range, Vec2 repeats, int axis) {
  return range.low[axis] * repeats[axis] >= -rounding &&
         range.high[axis] * repeats[axis] <= 1 + rounding;
}

/// Whether every edge of a cage has a face on both sides.
bool isClosed(const surface::Cage& cage) {
  std::map<std::pair<int, int>, int> faces;  // that an edge has
  const std::size_t size = cage.faceSize();
  for (std::size_t first = 0; first < cage.faceVertices.size(); first += size) {
    for (std::size_t k = 0; k < size; ++k) {
      const int from = cage.faceVertices[first + k];
      const int to = cage.faceVertices[first + (k + 1) % size];
      ++faces[std::minmax(from, to)];
    }
  }
  return std::all_of(faces.begin(), faces.end(), [](const auto& edge) { return edge.second >= 2; });
}

/// Whether the first and the last face of a row, or of a column, do not meet.
Border openEnds(const surface::LimitSurface& surface) {
  const auto grid = surface.grid();
  if (!grid) return {};
  const auto first = surface.corners(0);
  const auto lastInRow = surface.corners(grid->columns - 1);
  const auto lastInColumn = surface.corners((grid->rows - 1) * grid->columns);
  return {lastInRow[1] != first[0], lastInColumn[3] != first[0]};
}

}  // namespace

Border borderOf(const surface::Cage& cage, const surface::LimitSurface& surface, Wrap wrap,
                Vec2 repeats) {
  const UvRange range = uvRange(cage);
  const Border open = openEnds(surface);
  const auto isBorder = [&](int axis, bool isOpen) {
    return isLaidOnce(range, repeats, axis) && (wrap == Wrap::clamp || isOpen);
  };
  return {isBorder(0, open.x), isBorder(1, open.y)};
}

Wrap defaultWrap(const surface::Cage& cage, Vec2 repeats) {
  const UvRange range = uvRange(cage);
  const bool isOnce = isLaidOnce(range, repeats, 0) && isLaidOnce(range, repeats, 1);
  return isOnce && !cage.grid && !isClosed(cage) ? Wrap::clamp : Wrap::repeat;
}

}  // namespace gnomon::relief
