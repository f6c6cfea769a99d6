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

namespace {

/// The first of `count` pixels whose centre is not before a share of the side.
int firstFrom(double share, int count) {
  return std::clamp(static_cast<int>(std::ceil(share * count - 0.5)), 0, count);
}

}  // namespace

std::optional<ViewPart> partBetween(Vec2 one, Vec2 other, const PaneRectangle& pane) {
  const auto shareOf = [&](Vec2 place) {
    return glm::clamp((place - pane.corner) / pane.size, Vec2(0), Vec2(1));
  };
  const Vec2 low = glm::min(shareOf(one), shareOf(other));
  const Vec2 high = glm::max(shareOf(one), shareOf(other));
  const bool hasArea = low.x < high.x && low.y < high.y;
  return hasArea ? std::optional(ViewPart{low.x, low.y, high.x, high.y}) : std::nullopt;
}

PaneRectangle placeOf(const ViewPart& part, const PaneRectangle& pane) {
  return {pane.corner + Vec2(part.left, part.top) * pane.size,
          Vec2(part.right - part.left, part.bottom - part.top) * pane.size};
}

std::vector<std::uint8_t> pixelsIn(const ViewPart& part, int width, int height) {
  const auto side = static_cast<std::size_t>(width);
  std::vector<std::uint8_t> pixels(side * static_cast<std::size_t>(height), 0);
  const int begin = firstFrom(part.left, width);
  const int end = firstFrom(part.right, width);
  for (int row = firstFrom(part.top, height); row < firstFrom(part.bottom, height); ++row) {
    const auto line = pixels.begin() + static_cast<std::ptrdiff_t>(row) * width;
    std::fill(line + begin, line + end, std::uint8_t{1});
  }
  return pixels;
}

}  // namespace gnomon::app
