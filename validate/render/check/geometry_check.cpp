#include "render/check/box_scene.h"
#include "render/check/pass_faults.h"
#include "render/check/tally.h"

namespace gnomon::render::check {
namespace {

/// Compares both answers of a method: `test` says hidden, unless it is not asked; `drawn` dark.
enum class Asked { both, drawnAlone };

void compareBox(Tally& tally, const Shaders& shaders, const Method& method, const BoxScene& box,
                const Camera& camera, Asked asked) {
  const MethodPass pass(shaders, method, relief::Wrap::repeat, TableFilter::exact, {});
  const MethodAnswers answers = pass.render(box.view(camera), box.drawing(), {});
  const std::vector<SeenPoint> points = seenPoints(camera);
  const bool castsShadows = method.passes.lightDepth || method.passes.shadowVolumes;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SeenPoint& seen = points[i];
    if (!seen.isClear) continue;
    const auto shade = [&](bool isDark) {
      return seen.face < 0 ? Shade::none : isDark ? Shade::shadowed : Shade::lit;
    };
    const bool isRight =
        answers.drawn.samples.at(i) == shade(castsShadows ? seen.isHidden : seen.isTurned) &&
        (asked == Asked::drawnAlone ||
         answers.test.samples.at(i) == shade(castsShadows && seen.isHidden));
    tally.add(isRight);
  }
}

}  // namespace

std::string facetFault(const Shaders& shaders) {
  const Method method = methodOf(
      DrawnMesh::displaced, "bool isShadowed(Pixel pixel, LocalLight light) { return false; }\n");
  const BoxScene box;
  Tally tally;
  for (const Camera& camera : BoxScene::cameras()) {
    compareBox(tally, shaders, method, box, camera, Asked::both);
  }
  return tally.fault();
}

std::string lightDepthFault(const Shaders& shaders) {
  // Nearer to the light by more than 0.3, where the box is above the floor by 2 and more.
  Method method = methodOf(DrawnMesh::displaced,
                           "bool isShadowed(Pixel pixel, LocalLight light) {\n"
                           "  vec3 place = lightMapPlace(pixel.position);\n"
                           "  float before = place.z - lightDepthOf(ivec2(floor(place.xy)));\n"
                           "  return before * lightMapLengths.y > 0.3;\n"
                           "}\n");
  method.passes.lightDepth = true;
  method.parameters["depth_side"] = {512, 512, 512, ""};
  Tally tally;
  // Where a side is turned from the light, how deep it lies in the box decides: not asked.
  compareBox(tally, shaders, method, BoxScene(), BoxScene::cameras().front(), Asked::drawnAlone);
  return tally.fault();
}

std::string volumeFault(const Shaders& shaders) {
  Method method =
      methodOf(DrawnMesh::displaced,
               "bool isShadowed(Pixel pixel, LocalLight light) { return shadowCount() != 0u; }\n");
  method.passes.shadowVolumes = true;
  const BoxScene box;
  Tally tally;
  for (const Camera& camera : BoxScene::cameras()) {
    compareBox(tally, shaders, method, box, camera, Asked::both);
  }
  return tally.fault();
}

}  // namespace gnomon::render::check
