#include "relief/patch_border.h"

#include <algorithm>

namespace gnomon::relief {
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
    const bool isOnce = range.low[axis] * repeats[axis] >= -rounding &&
                        range.high[axis] * repeats[axis] <= 1 + rounding;
    return isOnce && (wrap == Wrap::clamp || isOpen);
  };
  return {isBorder(0, open.x), isBorder(1, open.y)};
}

}  // namespace gnomon::relief
