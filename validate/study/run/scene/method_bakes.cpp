#include "study/run/scene/method_bakes.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

#include "render/bakes/bake_pass.h"
#include "render/passes/texel_counter.h"
#include "study/run/scene/cached_fields.h"

namespace gnomon::study {
namespace {

std::uint64_t bytesOfAll(const std::vector<render::GpuBake>& bakes) {
  return std::accumulate(
      bakes.begin(), bakes.end(), std::uint64_t{0},
      [](std::uint64_t sum, const auto& bake) { return sum + bake.byteCount(); });
}

/// Whether bakes are small enough to be kept on disk.
bool areKept(const render::Method& method, glm::ivec2 map) {
  constexpr double mostBytes = 5e8;
  double bytes = 0;
  for (const render::MethodBake& bake : method.bakes) {
    bytes += static_cast<double>(render::bytesOver(bake, map));
  }
  return bytes <= mostBytes;
}

/// The functions that bake, compiled once for all cases.
std::shared_ptr<const render::BakePass> compiledPass(RunScene& scene, const MethodSpec& spec,
                                                     const render::Method& method) {
  return scene.cache.share(
      scene.keys.program(spec, method),
      [&] {
        return render::BakePass(scene.shaders, method, scene.study.relief.field.wrap(), spec.filter,
                                spec.parameters, !isBuiltIn(spec) && render::hasLoops(method));
      },
      programBytes);
}

}  // namespace

std::shared_ptr<const std::vector<render::GpuBake>> methodBakes(RunScene& scene,
                                                                const MethodSpec& spec,
                                                                const render::Method& method,
                                                                const render::GpuTables& tables) {
  if (method.bakes.empty()) return nullptr;
  render::requireBakeSizes(method, scene.heights.size());
  const relief::Relief& relief = scene.study.relief;
  const render::BakeScene from{scene.heights, relief.field.wrap(), relief.space,
                               scene.texelsPerHeight};
  return scene.clock.measure("bake", [&](const Progress& progress) {
    const auto pass = compiledPass(scene, spec, method);
    const cache::ContentKey key =
        scene.keys.methodBakes(spec, method, pass->parameters(), scene.texelsPerHeight);
    const auto bake = [&] { return pass->bake(from, tables, progress); };
    return scene.cache.share(
        key,
        [&] {
          const auto stored =
              areKept(method, scene.heights.size()) ? scene.cache.remember(key, bake) : bake();
          return render::gpuBakes(method, stored, from);
        },
        bytesOfAll);
  });
}

}  // namespace gnomon::study
