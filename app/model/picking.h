#pragma once

#include <optional>

#include "common/vec.h"
#include "surface/sample_grid.h"

namespace gnomon::app {

/// A pixel of a view; row 0 at the top.
struct ViewPixel {
  int column = 0;
  int row = 0;
  bool operator==(const ViewPixel&) const = default;
};

/// The rectangle of a window that shows a view: the whole picture, stretched to it. Window
/// coordinates, y downward.
struct PaneRectangle {
  Vec2 corner{0, 0};  ///< upper left
  Vec2 size{0, 0};
};

/// The pixel of a view under a place of the window; none outside the rectangle. The left and upper
/// border belong to it, the others do not.
std::optional<ViewPixel> pixelUnder(Vec2 cursor, const PaneRectangle& rectangle, int width,
                                    int height);

/// The sample that a pixel shows; none on the background or outside the grid.
std::optional<surface::SurfaceSample> sampleUnder(const surface::SampleGrid& samples,
                                                  ViewPixel pixel);

}  // namespace gnomon::app
