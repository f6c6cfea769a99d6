#pragma once

#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "displaced/displaced_mesh.h"
#include "horizon/angle_table.h"
#include "horizon/horizon_bake.h"
#include "horizon/stored_table.h"
#include "relief/relief.h"
#include "render/bakes/bake_pass.h"
#include "render/gl_context.h"
#include "render/gpu_scene.h"
#include "render/passes/drawing.h"
#include "render/passes/method_pass.h"
#include "surface/base_mesh.h"
#include "surface/cage/shapes.h"
#include "surface/limit_surface.h"
#include "surface/texture_layout.h"
#include "truth/truth_scenes.h"

namespace gnomon::test {

/// A surface with a relief on the GPU, its tables baked: what a method needs to answer.
class RenderScene {
 public:
  RenderScene(const surface::Cage& cage, relief::Relief heights, const horizon::BakeSettings& bake,
              horizon::TableBits bits, int subdivisions = 1)
      : surface(cage),
        relief(std::move(heights)),
        frame(horizon::texelsPerHeight(relief.space,
                                       horizon::texelScale(surface, relief.texelsPerUv()))),
        tables(horizon::bakeHorizons(relief.field, bake)),
        horizon(horizon::storeTable(tables.horizon, bits)),
        distance(horizon::storeTable(tables.distance, bits)),
        mesh(surface::makeBaseMesh(surface, relief.texelsPerUv(), subdivisions)),
        texture(render::textureView(mesh)),
        bits_(bits),
        layout_(surface::textureLayout(surface)),
        gpuMesh_(mesh, &layout_),
        gpuHeights_(relief.field),
        gpuHorizon_(horizon, tables),
        gpuDistance_(distance, tables) {}

  /// @param radius  of the light's disc, radians
  [[nodiscard]] render::Drawing drawing(const Vec3& light, double radius = 0) const {
    return {gpuMesh_, gpuHeights_, relief.field.wrap(), relief.space, frame, {light, radius},
            nullptr,  &texture};
  }

  /// The drawn answer.
  [[nodiscard]] Mask answer(const std::string& method, const render::RenderView& view,
                            const Vec3& light,
                            render::TableFilter filter = render::TableFilter::exact) const {
    const auto shaders = render::shaderFolder();
    return answer(render::readMethod(render::methodFile(shaders, method)), view, light, filter);
  }

  [[nodiscard]] Mask answer(const render::Method& method, const render::RenderView& view,
                            const Vec3& light,
                            render::TableFilter filter = render::TableFilter::exact,
                            const std::map<std::string, double>& parameters = {}) const {
    return answers(method, view, {light}, filter, parameters).front().drawn;
  }

  /// What the shadow test alone says.
  [[nodiscard]] Mask test(const std::string& method, const render::RenderView& view,
                          const Vec3& light,
                          render::TableFilter filter = render::TableFilter::exact) const {
    return test(render::readMethod(render::methodFile(render::shaderFolder(), method)), view, light,
                filter);
  }

  [[nodiscard]] Mask test(const render::Method& method, const render::RenderView& view,
                          const Vec3& light,
                          render::TableFilter filter = render::TableFilter::exact,
                          const std::map<std::string, double>& parameters = {}) const {
    return answers(method, view, {light}, filter, parameters).front().test;
  }

  /// Both answers for each light; the shader and its tables are made once.
  [[nodiscard]] std::vector<render::MethodAnswers> answers(
      const render::Method& method, const render::RenderView& view, const std::vector<Vec3>& lights,
      render::TableFilter filter = render::TableFilter::exact,
      const std::map<std::string, double>& parameters = {}) const {
    const render::MethodPass pass(render::shaderFolder(), method, relief.field.wrap(), filter,
                                  parameters);
    std::vector<render::MethodAnswers> found;
    withInputs(method, parameters, [&](render::Drawing drawn, const render::GpuTables& gpu) {
      for (const Vec3& light : lights) {
        drawn.light.direction = light;
        found.push_back(pass.render(view, drawn, gpu));
      }
    });
    return found;
  }

  /// The shares of a light's disc that a method answers with.
  /// @param radius  of the disc, radians
  [[nodiscard]] render::VisibilityAnswers shares(
      const render::Method& method, const render::RenderView& view, const Vec3& light,
      double radius, render::SoftAnswer soft = render::SoftAnswer::own,
      const std::map<std::string, double>& parameters = {}) const {
    const render::MethodPass pass(render::shaderFolder(), method, relief.field.wrap(),
                                  render::TableFilter::exact, parameters, soft);
    render::VisibilityAnswers found;
    withInputs(method, parameters, [&](render::Drawing drawn, const render::GpuTables& gpu) {
      drawn.light.direction = light;
      drawn.light.radius = radius;
      found = pass.renderVisibility(view, drawn, gpu);
    });
    return found;
  }

  /// What a method's own bakes are made from.
  [[nodiscard]] render::BakeScene bakeScene() const {
    return {gpuHeights_, relief.field.wrap(), relief.space, frame};
  }
  [[nodiscard]] std::vector<render::StoredBake> storedBakes(
      const render::Method& method, const render::GpuTables& gpu,
      const std::map<std::string, double>& parameters = {}) const {
    return render::BakePass(render::shaderFolder(), method, relief.field.wrap(),
                            render::TableFilter::exact, parameters)
        .bake(bakeScene(), gpu);
  }
  [[nodiscard]] std::vector<render::GpuBake> bakes(
      const render::Method& method, const render::GpuTables& gpu,
      const std::map<std::string, double>& parameters = {}) const {
    return render::gpuBakes(method, storedBakes(method, gpu, parameters), bakeScene());
  }

  /// Calls `use(drawing, tables)` with all that a method declares.
  template <typename Use>
  void withInputs(const render::Method& method, const std::map<std::string, double>& parameters,
                  const Use& use) const {
    render::GpuTables gpu{&gpuHorizon_, &gpuDistance_};
    gpu.searchRadius = tables.radiusTexels;
    std::optional<render::GpuAngles> angles;
    std::optional<render::GpuTable> ellipses;
    if (method.tables.angles)
      angles.emplace(horizon::horizonAngles(tables, angleLimit, frame), bits_);
    if (method.tables.surfaceAngles) angles.emplace(surfaceAngles.value(), bits_);
    if (method.tables.ellipse) {
      const horizon::EllipseTable fit = horizon::fitEllipses(tables, frame);
      ellipses.emplace(horizon::storeTable(fit.values, bits_), fit);
    }
    if (angles) gpu.angles = &*angles;
    if (ellipses) gpu.ellipse = &*ellipses;
    std::vector<render::GpuBake> own;
    if (!method.bakes.empty()) {
      own = bakes(method, gpu, parameters);
      gpu.bakes = &own;
    }
    std::optional<render::GpuMesh> lightMesh;
    if (method.lightMesh) {
      const int pieces = render::lightPieces(method, parameters);
      lightMesh.emplace(displaced::makeDisplacedMesh(surface, relief, pieces).mesh);
    }
    render::Drawing drawn = drawing({0, 0, 1});
    if (lightMesh) drawn.lightMesh = &*lightMesh;
    use(drawn, gpu);
  }

  [[nodiscard]] surface::SampleGrid samples(const render::RenderView& view) const {
    return render::SamplesPass(render::shaderFolder()).render(view, gpuMesh_);
  }

  surface::LimitSurface surface;
  relief::Relief relief;
  double frame;  ///< texels a height unit, of angles
  horizon::HorizonTables tables;
  horizon::StoredTable horizon;
  horizon::StoredTable distance;
  surface::BaseMesh mesh;
  render::RenderView texture;                        ///< all unique texels
  double angleLimit = pi / 2;                        ///< of horizon angles
  std::optional<horizon::AngleTable> surfaceAngles;  ///< for methods that read them

 private:
  horizon::TableBits bits_;
  surface::TextureLayout layout_;
  render::GpuMesh gpuMesh_;
  render::GpuHeights gpuHeights_;
  render::GpuTable gpuHorizon_;
  render::GpuTable gpuDistance_;
};

/// Bumps on a sphere; and with u running backward and the map with it, so that the relief in the
/// world is the same.
struct MirroredScenes {
  explicit MirroredScenes(int azimuths)
      : scene(sphere(false), bumps(false), {azimuths, 32}, horizon::TableBits::thirtyTwo),
        mirrored(sphere(true), bumps(true), {azimuths, 32}, horizon::TableBits::thirtyTwo) {}

  static surface::Cage sphere(bool isMirrored) {
    surface::Cage cage = surface::makeSphere(40, 1, 1, 16, 16);
    if (!isMirrored) return cage;
    for (Vec2& uv : cage.uvs) uv.x = 1 - uv.x;
    cage.grid.reset();
    return cage;
  }
  static relief::Relief bumps(bool isMirrored) {
    relief::Relief relief = randomRelief(32, 32, 2, 5);
    if (!isMirrored) return relief;
    std::vector<float> texels;
    for (int j = 0; j < 32; ++j) {
      for (int i = 0; i < 32; ++i) texels.push_back(relief.field.texel(31 - i, j));
    }
    return {relief::HeightField(32, 32, texels, relief::Wrap::repeat), relief::HeightSpace::world,
            Vec2(1)};
  }

  RenderScene scene, mirrored;
};

/// A surface as real geometry on the GPU.
class DisplacedScene {
 public:
  DisplacedScene(const surface::Cage& cage, relief::Relief heights, int subdivisions)
      : surface(cage),
        relief(std::move(heights)),
        displaced(displaced::makeDisplacedMesh(surface, relief, subdivisions)),
        gpuMesh_(displaced.mesh),
        gpuVolumes_(displaced),
        gpuHeights_(relief.field) {}

  [[nodiscard]] render::MethodAnswers answers(
      const std::string& method, const render::RenderView& view, const Vec3& light,
      const std::map<std::string, double>& parameters = {}) const {
    const render::Method read =
        render::readMethod(render::methodFile(render::shaderFolder(), method));
    const render::MethodPass pass(render::shaderFolder(), read, relief.field.wrap(),
                                  render::TableFilter::exact, parameters);
    return pass.render(view, drawing(light), {});
  }

  /// The shares of a light's disc that a method answers with.
  /// @param radius  of the disc, radians
  [[nodiscard]] render::VisibilityAnswers shares(
      const std::string& method, const render::RenderView& view, const Vec3& light, double radius,
      const std::map<std::string, double>& parameters = {}) const {
    const render::Method read =
        render::readMethod(render::methodFile(render::shaderFolder(), method));
    const render::MethodPass pass(render::shaderFolder(), read, relief.field.wrap(),
                                  render::TableFilter::exact, parameters);
    render::Drawing drawn = drawing(light);
    drawn.light.radius = radius;
    return pass.renderVisibility(view, drawn, {});
  }

  [[nodiscard]] render::Drawing drawing(const Vec3& light) const {
    return {gpuMesh_, gpuHeights_, relief.field.wrap(), relief.space, 1, {light}, &gpuVolumes_};
  }

  [[nodiscard]] Mask answer(const std::string& method, const render::RenderView& view,
                            const Vec3& light,
                            const std::map<std::string, double>& parameters = {}) const {
    return answers(method, view, light, parameters).drawn;
  }

  [[nodiscard]] surface::SampleGrid samples(const render::RenderView& view) const {
    return render::SamplesPass(render::shaderFolder()).render(view, gpuMesh_);
  }

  surface::LimitSurface surface;
  relief::Relief relief;
  displaced::DisplacedMesh displaced;

 private:
  render::GpuMesh gpuMesh_;
  render::GpuVolumes gpuVolumes_;
  render::GpuHeights gpuHeights_;
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

/// A plane of 16² texels with a step across it.
inline RenderScene stepScene() {
  return {surface::makePlane(16, 16, 2, 2),
          stepRelief(16, 16, 3, [](int i, int) { return i < 8; }),
          {8, 16},
          horizon::TableBits::thirtyTwo};
}

}  // namespace gnomon::test
