#pragma once

#include <cmath>
#include <memory>
#include <string>

#include "relief/horizon_bake.h"
#include "relief/relief.h"
#include "relief/stored_table.h"
#include "render/gl_context.h"
#include "render/method_pass.h"
#include "render/passes.h"
#include "render/view.h"
#include "surface/base_mesh.h"
#include "surface/limit_surface.h"
#include "surface/shapes.h"

namespace gnomon::test {

/// A surface with a relief on the GPU, its tables baked: what a method needs to answer.
class RenderScene {
 public:
  RenderScene(const Cage& cage, Relief heights, const BakeSettings& bake, TableBits bits,
              int subdivisions = 1)
      : surface(cage),
        relief(std::move(heights)),
        tables(bakeHorizons(relief.field, bake)),
        horizon(storeTable(tables.horizon, bits)),
        distance(storeTable(tables.distance, bits)),
        mesh(makeBaseMesh(surface, relief.texelsPerUv(), subdivisions)),
        gpuMesh_(mesh),
        gpuHeights_(relief.field),
        gpuHorizon_(horizon, tables.width, tables.height, tables.azimuths, tables.wrap),
        gpuDistance_(distance, tables.width, tables.height, tables.azimuths, tables.wrap) {}

  [[nodiscard]] Drawing drawing(const Vec3& light) const {
    return {gpuMesh_, gpuHeights_, relief.field.wrap(), relief.space, light};
  }

  [[nodiscard]] Mask answer(const std::string& method, const RenderView& view, const Vec3& light,
                            TableFilter filter = TableFilter::exact) const {
    const auto shaders = shaderFolder();
    return answer(readMethod(methodFile(shaders, method)), view, light, filter);
  }

  [[nodiscard]] Mask answer(const Method& method, const RenderView& view, const Vec3& light,
                            TableFilter filter = TableFilter::exact,
                            const std::map<std::string, double>& parameters = {}) const {
    const MethodPass pass(shaderFolder(), method, relief.field.wrap(), filter, parameters);
    return pass.render(view, drawing(light), {&gpuHorizon_, &gpuDistance_});
  }

  [[nodiscard]] SampleGrid samples(const RenderView& view) const {
    return SamplesPass(shaderFolder()).render(view, gpuMesh_);
  }

  LimitSurface surface;
  Relief relief;
  HorizonTables tables;
  StoredTable horizon;
  StoredTable distance;
  BaseMesh mesh;

 private:
  GpuMesh gpuMesh_;
  GpuHeights gpuHeights_;
  GpuTable gpuHorizon_;
  GpuTable gpuDistance_;
};

/// Share of samples on which two masks of one view differ.
inline double difference(const Mask& a, const Mask& b) {
  std::size_t differ = 0;
  std::size_t all = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a.samples[i] == Shade::none && b.samples[i] == Shade::none) continue;
    ++all;
    differ += a.samples[i] != b.samples[i] ? 1 : 0;
  }
  return all == 0 ? 1.0 : static_cast<double>(differ) / static_cast<double>(all);
}

inline double shareShadowed(const Mask& mask) {
  std::size_t dark = 0;
  std::size_t all = 0;
  for (const Shade shade : mask.samples) {
    if (shade == Shade::none) continue;
    ++all;
    dark += shade == Shade::shadowed ? 1 : 0;
  }
  return static_cast<double>(dark) / static_cast<double>(all);
}

}  // namespace gnomon::test
