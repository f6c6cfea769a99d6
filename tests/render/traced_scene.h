#pragma once

#include "render/render_scene.h"
#include "truth/micro_scene.h"
#include "truth/shadow_tracer.h"
#include "truth/surface_horizons.h"
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
    return truth::traceShadows(surface, relief, mesh, scene, samples, truth::TraceSettings{{light}})
        .mask;
  }
};

/// Horizon angles that rays find on the surface itself, at every unique texel of it.
/// @param limit  of the angles, radians
inline horizon::AngleTable shot(const RenderScene& scene, const TracedScene& traced, int azimuths,
                                double limit) {
  const surface::SampleGrid texels = scene.samples(scene.texture);
  horizon::AngleTable table = truth::shootHorizons(scene.surface, scene.relief, traced.mesh,
                                                   traced.scene, texels, azimuths, limit);
  table.originX = scene.texture.texelWindow.x;
  table.originY = scene.texture.texelWindow.y;
  return table;
}

}  // namespace gnomon::test
