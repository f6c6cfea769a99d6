// The march over maps of the surface: what the other marches cannot know of it.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "relief/patterns.h"
#include "render/render_scene.h"
#include "truth/truth_scenes.h"

namespace gnomon::render {
namespace {

using test::difference;
using test::RenderScene;
using test::shareShadowed;

/// A mask of an atlas that closes at its sides, moved `columns` samples to the right.
Mask turnedBy(const Mask& mask, int columns) {
  Mask turned = mask;
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x) {
      const int from = (x + mask.width - columns) % mask.width;
      turned.samples[static_cast<std::size_t>(y * mask.width + x)] =
          mask.samples[static_cast<std::size_t>(y * mask.width + from)];
    }
  }
  return turned;
}

/// Four columns stand around a torus: a light a quarter turn further casts the same shadows, a
/// quarter further. Some of either cross the map's border, where the torus closes.
TEST(SurfaceMarch, GoesOnWhereAMapCloses) {
  const GlContext gl;
  const relief::Relief columns{relief::makeColumns(96, 48, {24, 10, 1}, 4, relief::Wrap::repeat),
                               relief::HeightSpace::world, Vec2(1)};
  const RenderScene scene(surface::makeTorus(40, 10, 60, 60), columns, {4, 96},
                          horizon::TableBits::eight, 4);
  const RenderView view = atlasView(scene.surface, 4);
  const auto from = [&](double longitude) {
    const Vec3 light(std::sin(longitude), 0.2, std::cos(longitude));
    return scene.answer("surface-march", view, glm::normalize(light));
  };
  const Mask first = from(2.0);
  const Mask second = from(2.0 + pi / 2);
  EXPECT_GT(shareShadowed(first), 0.2);
  EXPECT_LT(difference(turnedBy(first, view.width / 4), second), 1e-3);
  EXPECT_GT(difference(first, second), 0.1) << "a control: not the same without the turn";
}

}  // namespace
}  // namespace gnomon::render
