#pragma once

#include "truth/micro_scene.h"
#include "truth/shadow_tracer.h"
#include "truth/truth_scenes.h"

namespace gnomon::test {

/// A displaced surface to trace the samples of a rendered view on.
struct TracedScene {
  truth::MicroMesh mesh;
  truth::MicroScene scene;

  TracedScene(const surface::LimitSurface& surface, const relief::Relief& relief, double stepTexels)
      : mesh(surface, relief, {stepTexels, 0}), scene(mesh) {}

  [[nodiscard]] Mask mask(const surface::LimitSurface& surface, const relief::Relief& relief,
                          const surface::SampleGrid& samples, const Vec3& light) const {
    return truth::traceShadows(surface, relief, mesh, scene, samples,
                               {light, 1000, truth::standardRayOffset})
        .mask;
  }
};

}  // namespace gnomon::test
