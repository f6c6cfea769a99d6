#pragma once

#include <utility>

#include "relief/relief.h"
#include "surface/cage/cage.h"
#include "surface/limit_surface.h"
#include "truth/micro_mesh.h"
#include "truth/micro_scene.h"

namespace gnomon::test {

/// A surface with its relief, ready to be traced.
struct MicroSurface {
  surface::LimitSurface surface;
  relief::Relief relief;
  truth::MicroMesh mesh;
  truth::MicroScene scene;

  MicroSurface(const surface::Cage& cage, relief::Relief heights, double stepTexels)
      : surface(cage),
        relief(std::move(heights)),
        mesh(surface, relief, {stepTexels, 0}),
        scene(mesh) {}
};

}  // namespace gnomon::test
