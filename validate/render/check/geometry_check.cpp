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
  const MethodPasses& passes = method.passes;
  const bool castsShadows =
      passes.lightDepth || passes.shadowVolumes || passes.hasOwn(PassRaster::light);
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

std::string faultOfEveryCamera(const Shaders& shaders, const Method& method) {
  const BoxScene box;
  Tally tally;
  for (const Camera& camera : BoxScene::cameras()) {
    compareBox(tally, shaders, method, box, camera, Asked::both);
  }
  return tally.fault();
}

/// By the first camera. Where a side is turned from the light, how deep it lies in the box decides:
/// not asked.
std::string faultFromTheLight(const Shaders& shaders, const Method& method) {
  Tally tally;
  compareBox(tally, shaders, method, BoxScene(), BoxScene::cameras().front(), Asked::drawnAlone);
  return tally.fault();
}

}  // namespace

std::string facetFault(const Shaders& shaders) {
  const Method method = methodOf(
      DrawnMesh::displaced, "bool isShadowed(Pixel pixel, LocalLight light) { return false; }\n");
  return faultOfEveryCamera(shaders, method);
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
  return faultFromTheLight(shaders, method);
}

std::string volumeFault(const Shaders& shaders) {
  Method method =
      methodOf(DrawnMesh::displaced,
               "bool isShadowed(Pixel pixel, LocalLight light) { return shadowCount() != 0u; }\n");
  method.passes.shadowVolumes = true;
  return faultOfEveryCamera(shaders, method);
}

std::string ownLightFault(const Shaders& shaders) {
  // As above; what the levels, the filter and the depth say apart turns the answer over.
  Method method =
      methodOf(DrawnMesh::displaced,
               "vec2 passSeen(Pixel pixel, float depth) { return vec2(depth, 1.0); }\n"
               "vec2 passCopied(ivec2 texel) { return seenTexel(texel); }\n"
               "bool isShadowed(Pixel pixel, LocalLight light) {\n"
               "  vec3 place = lightMapPlace(pixel.position);\n"
               "  ivec2 texel = ivec2(floor(place.xy));\n"
               "  float depth = copiedTexel(texel).x;\n"
               "  float covered = copiedTexel(ivec2(0), 9).y;\n"
               "  vec2 corner = seenTexel(ivec2(0));\n"
               "  bool isOdd = abs(depth - lightDepthOf(texel)) > 1e-6 || covered < 0.01 ||\n"
               "               covered > 0.99 || corner.x != 1.0 || corner.y != 0.0;\n"
               "  return ((place.z - lightDepthOf(texel)) * lightMapLengths.y > 0.3) != isOdd;\n"
               "}\n");
  OwnPass seen;
  seen.name = "seen";
  seen.raster = seen.root = PassRaster::light;
  seen.channels = 2;
  seen.clear = {1, 0, 0, 0};
  OwnPass copied = seen;
  copied.name = "copied";
  copied.raster = PassRaster::filter;
  copied.source = 0;
  copied.mips = true;
  method.passes.own = {seen, copied};
  method.parameters["depth_side"] = {512, 512, 512};
  return faultFromTheLight(shaders, method);
}

std::string cameraPassFault(const Shaders& shaders) {
  // Shadowed where the ways to tell a pixel's point do not agree.
  Method method =
      methodOf(DrawnMesh::displaced,
               "vec3 passSeen(Pixel pixel) { return pixel.position; }\n"
               "vec4 passCopied(ivec2 texel) { return vec4(seenTexel(texel), 1.0); }\n"
               "bool isShadowed(Pixel pixel, LocalLight light) {\n"
               "  ivec2 at = ivec2(gl_FragCoord.xy);\n"
               "  vec3 byDepth = cameraPoint(vec3(gl_FragCoord.xy, cameraDepthOf(at)));\n"
               "  vec3 nearer = pixel.position + 0.1 * viewDirection(pixel);\n"
               "  return distance(byDepth, pixel.position) > 0.02 ||\n"
               "         distance(copiedTexel(at).xyz, pixel.position) > 1e-3 ||\n"
               "         distance(cameraPlace(nearer).xy, gl_FragCoord.xy) > 0.05 ||\n"
               "         cameraPlace(nearer).z > cameraDepthOf(at);\n"
               "}\n");
  method.passes.cameraDepth = true;
  OwnPass seen;
  seen.name = "seen";
  seen.raster = seen.root = PassRaster::camera;
  seen.channels = 3;
  OwnPass copied = seen;
  copied.name = "copied";
  copied.raster = PassRaster::filter;
  copied.source = 0;
  copied.channels = 4;
  method.passes.own = {seen, copied};
  return faultOfEveryCamera(shaders, method);
}

}  // namespace gnomon::render::check
