#include "study/run/scene/base_case.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>

#include "common/error.h"
#include "common/system/memory.h"
#include "render/passes/drawing.h"
#include "study/run/scene/cached_fields.h"
#include "study/run/scene/view_samples.h"
#include "study/spec/method_changes.h"

namespace gnomon::study {
namespace {

/// Refuses a view whose samples, truths and masks do not fit in memory.
void requireRoom(const StudySpec& study, int width, int height, const std::string& name) {
  const double samples = static_cast<double>(width) * height;
  const std::string what = fmt::format("view \"{}\": {} × {} samples", name, width, height);
  // OpenGL drivers count the bytes of a picture in 32 bits; the largest has 8 a sample.
  constexpr double mostSamples = 1 << 27;
  if (samples > mostSamples) {
    throw InputError(fmt::format("{} found, at most {} expected", what, mostSamples));
  }
  constexpr double bytesWhileRendering = 64;
  constexpr double bytesOfWeightsAndPlaces =
      sizeof(double) + sizeof(surface::SurfaceSample) + sizeof(std::uint8_t);
  // A truth, the coarser one that it is compared with, and whether the path crosses a seam.
  constexpr double bytesOfTruth = 2 * (sizeof(Shade) + sizeof(truth::Region)) + 1;
  requireMemory(samples * (bytesWhileRendering + bytesOfWeightsAndPlaces +
                           bytesOfTruth * static_cast<double>(study.lights.size()) +
                           sizeof(Shade) * static_cast<double>(study.methods.size())),
                what);
}

bool isEmpty(const surface::SampleGrid& grid) {
  return std::all_of(grid.samples.begin(), grid.samples.end(),
                     [](const surface::SurfaceSample& sample) { return !sample.isOnSurface(); });
}

/// What is kept of a view.
struct ChosenSamples {
  render::RenderView view;
  surface::SampleGrid samples;
  compare::SampleLayout layout;
  std::vector<double> weights;
};

template <typename Stream, cache::SameAs<ChosenSamples> T>
void fields(Stream& stream, T& chosen) {
  stream(chosen.view, chosen.samples, chosen.layout, chosen.weights);
}

/// Draws the mesh to see its samples.
ChosenSamples chooseSamples(const StudySpec& study, const surface::LimitSurface& surface,
                            const DrawnBase& drawn, const std::filesystem::path& shaders,
                            const ViewSpec& spec) {
  ChosenSamples chosen;
  chosen.view = renderView(spec, surface, drawn.mesh);
  chosen.samples = render::SamplesPass(shaders).render(chosen.view, drawn.gpu);
  if (isEmpty(chosen.samples)) {
    throw InputError(
        fmt::format("view \"{}\" shows no surface: check eye, target and fov", spec.name));
  }
  chosen.layout =
      makeSampleLayout(surface, study.relief.texelsPerUv(), spec.kind, chosen.view, chosen.samples);
  chosen.weights = sampleWeights(spec, surface, chosen.samples);
  return chosen;
}

DrawnBase undisplaced(const StudySpec& study, const surface::LimitSurface& surface,
                      const surface::TextureLayout& layout, const MeshChoice& choice) {
  surface::BaseMesh mesh = withKeys("base", [&] {
    return surface::makeBaseMesh(surface, study.relief.texelsPerUv(), choice.base.subdivisions,
                                 choice.base.curvature);
  });
  render::GpuMesh gpu(mesh, &layout);
  const render::RenderView texture = render::textureView(mesh);
  return {std::move(mesh), std::move(gpu), std::nullopt, texture};
}

DrawnBase displaced(const StudySpec& study, const surface::LimitSurface& surface,
                    const surface::TextureLayout& layout, const MeshChoice& choice) {
  displaced::DisplacedMesh displaced = withKeys("base", [&] {
    return displaced::makeDisplacedMesh(surface, study.relief, choice.base.subdivisions);
  });
  render::GpuMesh gpu(displaced.mesh, &layout);
  render::GpuVolumes volumes(displaced);
  const render::RenderView texture = render::textureView(displaced.mesh);
  return {std::move(displaced.mesh), std::move(gpu), std::move(volumes), texture};
}

/// About what a mesh takes, in memory and on the GPU.
std::uint64_t memoryOf(const DrawnBase& drawn) {
  const std::size_t copies = drawn.volumes ? 4 : 2;
  return copies * (drawn.mesh.vertices.size() * sizeof(surface::BaseVertex) +
                   drawn.mesh.triangles.size() * sizeof(std::uint32_t));
}

std::uint64_t memoryOf(const ChosenSamples& chosen) {
  return chosen.samples.samples.size() * sizeof(surface::SurfaceSample) +
         chosen.layout.breaks.size() + chosen.weights.size() * sizeof(double);
}

}  // namespace

OnDemand<std::shared_ptr<const DrawnBase>> drawnOnDemand(const StudySpec& study,
                                                         const surface::LimitSurface& surface,
                                                         MeshChoice choice, CaseMakers with) {
  const auto make = [&study, &surface, &layout = with.layout, choice] {
    return choice.kind == render::DrawnMesh::displaced
               ? displaced(study, surface, layout, choice)
               : undisplaced(study, surface, layout, choice);
  };
  return OnDemand<std::shared_ptr<const DrawnBase>>([make, with, choice] {
    return with.cache.share(with.keys.mesh(choice), make,
                            [](const DrawnBase& drawn) { return memoryOf(drawn); });
  });
}

BaseCase makeBaseCase(const StudySpec& study, const surface::LimitSurface& surface,
                      MeshChoice choice, CaseMakers with) {
  BaseCase base{choice, drawnOnDemand(study, surface, choice, with), {}};
  for (std::size_t v = 0; v < study.views.size(); ++v) {
    const ViewSpec& spec = study.views[v];
    const render::RenderView size = pictureSize(spec, surface);
    requireRoom(study, size.width, size.height, spec.name);
    const cache::ContentKey key = with.keys.samples(choice, v);
    const auto choose = [&] {
      return chooseSamples(study, surface, *base.drawn.get(), with.shaders, spec);
    };
    const std::shared_ptr<const ChosenSamples> chosen = with.cache.share(
        key, [&] { return with.cache.remember(key, choose); },
        [](const ChosenSamples& samples) { return memoryOf(samples); });
    base.views.push_back({chosen->view, chosen->samples, chosen->layout, chosen->weights, {}});
  }
  return base;
}

}  // namespace gnomon::study
