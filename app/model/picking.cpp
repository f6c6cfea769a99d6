#include "model/picking.h"

#include <algorithm>
#include <cmath>

namespace gnomon::app {

std::optional<ViewPixel> pixelUnder(Vec2 cursor, const PaneRectangle& rectangle, int width,
                                    int height) {
  const Vec2 place = (cursor - rectangle.corner) / rectangle.size;
  const bool inside = place.x >= 0 && place.x < 1 && place.y >= 0 && place.y < 1;
  if (!inside) return std::nullopt;
  return ViewPixel{std::min(static_cast<int>(place.x * width), width - 1),
                   std::min(static_cast<int>(place.y * height), height - 1)};
}

std::optional<surface::SurfaceSample> sampleUnder(const surface::SampleGrid& samples,
                                                  ViewPixel pixel) {
  const bool inside = pixel.column >= 0 && pixel.column < samples.width && pixel.row >= 0 &&
                      pixel.row < samples.height;
  if (!inside) return std::nullopt;
  const surface::SurfaceSample& sample =
      samples
          .samples[static_cast<std::size_t>(pixel.row) * static_cast<std::size_t>(samples.width) +
                   static_cast<std::size_t>(pixel.column)];
  return !sample.isOnSurface() ? std::nullopt : std::optional(sample);
}

}  // namespace gnomon::app
