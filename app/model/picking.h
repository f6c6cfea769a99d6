#pragma once

#include <cstdint>
#include <optional>
#include <vector>

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

/// An upright rectangle of a view. Its sides are shares of the picture's width and height, 0 to 1
/// from the left and from the top, so that it stays where it is when the picture changes its size.
struct ViewPart {
  double left = 0, top = 0, right = 1, bottom = 1;  ///< left ≤ right, top ≤ bottom
  friend bool operator==(const ViewPart&, const ViewPart&) = default;
};

/// The rectangle between two places of a window, cut off at the border of the pane.
/// @return nothing for one without an area
std::optional<ViewPart> partBetween(Vec2 one, Vec2 other, const PaneRectangle& pane);

/// Where a part lies in the window.
PaneRectangle placeOf(const ViewPart& part, const PaneRectangle& pane);

/// The pixels whose centres lie in a part; a centre on the left or upper side lies in it. Parts
/// that share a side have no pixel in common and leave none out between them.
/// @return one a pixel, row by row: 1 in the part, else 0
std::vector<std::uint8_t> pixelsIn(const ViewPart& part, int width, int height);

}  // namespace gnomon::app
