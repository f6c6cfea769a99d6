#include "viewer/panes/layout.h"

#include <algorithm>
#include <cmath>

namespace gnomon::app {
namespace {

constexpr double panelWidth = 312;
constexpr double sectionHeight = 268;

bool holds(const PaneRectangle& rectangle, Vec2 place) {
  const Vec2 in = place - rectangle.corner;
  return in.x >= 0 && in.y >= 0 && in.x < rectangle.size.x && in.y < rectangle.size.y;
}

}  // namespace

WindowLayout windowLayout(int width, int height, const WindowParts& parts) {
  // A window that is hardly larger than what stands beside the picture keeps some room for it.
  const double controls = parts.panel ? std::min(panelWidth, std::floor(width * 0.6)) : 0;
  const double below = parts.section ? std::min(sectionHeight, std::floor(height * 0.5)) : 0;
  WindowLayout layout;
  layout.paneCount = parts.paneCount;
  layout.panel = {{width - controls, 0}, {controls, height}};
  layout.pictures = {{0, 0}, {std::max(1.0, width - controls), std::max(1.0, height - below)}};
  layout.section = {{0, height - below}, {layout.pictures.size.x, below}};
  if (parts.paneCount < 4) {
    layout.panes.fill(layout.pictures);
    return layout;
  }
  constexpr double gap = 2;
  const Vec2 size = glm::max(glm::floor((layout.pictures.size - gap) / 2.0), Vec2(1));
  for (std::size_t i = 0; i < layout.panes.size(); ++i) {
    const std::size_t column = i % 2;
    const std::size_t row = i / 2;
    const Vec2 place(static_cast<double>(column), static_cast<double>(row));
    layout.panes.at(i) = {place * (size + gap), size};
  }
  return layout;
}

int paneUnder(const WindowLayout& layout, Vec2 place, double wipe) {
  if (!holds(layout.pictures, place)) return -1;
  if (layout.paneCount == 1) return 0;
  if (layout.paneCount == 2) return place.x < wipe * layout.pictures.size.x ? 0 : 1;
  for (std::size_t i = 0; i < layout.panes.size(); ++i) {
    if (holds(layout.panes.at(i), place)) return static_cast<int>(i);
  }
  return -1;
}

}  // namespace gnomon::app
