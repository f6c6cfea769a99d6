#pragma once

#include "truth/micro_scene.h"
#include "truth/shadow_tracer.h"
#include "truth/truth_scenes.h"

namespace gnomon::test {

/// A displaced surface to trace the samples of a rendered view on.
struct TracedScene {
  MicroMesh mesh;
  MicroScene scene;

  TracedScene(const LimitSurface& surface, const Relief& relief, double stepTexels)
      : mesh(surface, relief, {stepTexels, 0}), scene(mesh) {}

  [[nodiscard]] Mask mask(const LimitSurface& surface, const Relief& relief,
                          const SampleGrid& samples, const Vec3& light) const {
    return traceShadows(surface, relief, mesh, scene, samples, {light, 1000, standardRayOffset})
        .mask;
  }
};

}  // namespace gnomon::test
