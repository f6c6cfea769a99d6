#include <algorithm>
#include <cmath>

#include "render/check/box_scene.h"
#include "render/check/pass_faults.h"
#include "render/check/tally.h"
#include "render/check/tile_scene.h"
#include "render/passes/passes.h"

namespace gnomon::render::check {

std::string cameraFault(const Shaders& shaders) {
  const BoxScene box;
  const SamplesPass pass(shaders);
  constexpr double nearEnough = 1e-3;
  Tally tally;
  for (const Camera& camera : BoxScene::cameras()) {
    const surface::SampleGrid grid = pass.render(box.view(camera), box.drawing().mesh);
    const std::vector<SeenPoint> points = seenPoints(camera);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!points[i].isClear) continue;
      const surface::SurfaceSample& found = grid.samples.at(i);
      const Vec2 off = Vec2(found.s, found.t) - points[i].st;
      tally.add(found.face == points[i].face &&
                (found.face < 0 || std::max(std::abs(off.x), std::abs(off.y)) < nearEnough));
    }
  }
  return tally.fault();
}

std::string atlasFault(const Shaders& shaders) {
  using tile::columns;
  using tile::side;
  const surface::SampleGrid grid = SamplesPass(shaders).render(tileView(), GpuMesh(tileMesh()));
  constexpr double nearEnough = 1e-6;
  Tally tally;
  for (int row = 0; row < side; ++row) {
    for (int x = 0; x < columns; ++x) {
      const surface::SurfaceSample& found =
          grid.samples.at(static_cast<std::size_t>(row * columns + x));
      tally.add(found.face == x / side &&
                std::abs(found.s - (x % side + 0.5) / side) < nearEnough &&
                std::abs(found.t - (side - 1 - row + 0.5) / side) < nearEnough);
    }
  }
  return tally.fault();
}

}  // namespace gnomon::render::check
