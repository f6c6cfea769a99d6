#include <algorithm>
#include <cmath>

#include "render/check/box_scene.h"
#include "render/check/pass_faults.h"
#include "render/check/tally.h"
#include "render/passes/passes.h"

namespace gnomon::render::check {

std::string pictureFault(const Shaders& shaders) {
  const BoxScene box;
  const Camera& camera = BoxScene::cameras().front();
  const RenderView view = box.view(camera);
  Mask mask{view.width, view.height, {}};
  for (int i = 0; i < view.width * view.height; ++i) {
    const bool isDark = (i % view.width / 4 + i / view.width / 4) % 2 == 0;
    mask.samples.push_back(isDark ? Shade::shadowed : Shade::lit);
  }
  const auto picture = ShadePass(shaders, relief::Wrap::repeat, DrawnMesh::displaced)
                           .render(view, box.drawing(), mask);
  const std::vector<SeenPoint> points = seenPoints(camera);
  constexpr int white = 255;
  // As shade.frag has it: ambient light alone, and with it a cosine of at least 0.02.
  const auto red = [](double cosine) {
    const double light = 0.86 * (0.16 + 0.84 * cosine);
    return 255 * std::pow(light, 1 / 2.2);
  };
  Tally tally;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].isClear) continue;
    double expected = white;
    if (points[i].face >= 0) {
      const Rectangle& own = boxOverFloor().at(static_cast<std::size_t>(points[i].face));
      const Vec3 normal = glm::normalize(glm::cross(own.along, own.across));
      const bool isLit = mask.samples[i] == Shade::lit;
      expected = red(isLit ? std::max(glm::dot(normal, BoxScene::light()), 0.02) : 0);
    }
    tally.add(std::abs(picture.at(3 * i) - expected) < 1.5);
  }
  return tally.fault();
}

}  // namespace gnomon::render::check
