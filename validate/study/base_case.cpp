#include "study/base_case.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>

#include "common/error.h"
#include "common/memory.h"
#include "render/passes.h"
#include "study/cached_fields.h"
#include "study/view_layout.h"

namespace gnomon {
namespace {

/// Refuses a view whose samples, truths and masks cannot be held.
void requireRoom(const StudySpec& study, const RenderView& view, const std::string& name) {
  const double samples = static_cast<double>(view.width) * view.height;
  const std::string what =
      fmt::format("view \"{}\": {} × {} samples", name, view.width, view.height);
  // OpenGL drivers count the bytes of a picture in 32 bits; the largest has 8 a sample.
  constexpr double mostSamples = 1 << 27;
  if (samples > mostSamples) {
    throw InputError(fmt::format("{} found, at most {} expected", what, mostSamples));
  }
  constexpr double bytesWhileRendering = 64;
  constexpr double bytesOfWeightsAndPlaces =
      sizeof(double) + sizeof(SurfaceSample) + sizeof(std::uint8_t);
  // A truth, the coarser one that it is held against, and whether the path crosses a seam.
  constexpr double bytesOfTruth = 2 * (sizeof(Shade) + sizeof(Region)) + 1;
  requireMemory(samples * (bytesWhileRendering + bytesOfWeightsAndPlaces +
                           bytesOfTruth * static_cast<double>(study.lights.size()) +
                           sizeof(Shade) * static_cast<double>(study.methods.size())),
                what);
}

bool isEmpty(const SampleGrid& grid) {
  return std::all_of(grid.samples.begin(), grid.samples.end(),
                     [](const SurfaceSample& sample) { return sample.face < 0; });
}

/// What is kept of a view.
struct ChosenSamples {
  SampleGrid samples;
  SampleLayout layout;
  std::vector<double> weights;
};

template <typename Stream, SameAs<ChosenSamples> T>
void fields(Stream& stream, T& chosen) {
  stream(chosen.samples, chosen.layout, chosen.weights);
}

ChosenSamples chooseSamples(const StudySpec& study, const LimitSurface& surface,
                            const RenderView& view, SampleGrid samples, const ViewSpec& spec) {
  if (isEmpty(samples)) {
    throw InputError(
        fmt::format("view \"{}\" shows no surface: check eye, target and fov", spec.name));
  }
  ChosenSamples chosen;
  chosen.layout = makeSampleLayout(surface, study.relief.texelsPerUv(), view, samples);
  if (const auto* atlas = std::get_if<AtlasSpec>(&spec.kind)) {
    chosen.weights = sampleAreas(surface, samples, atlas->samplesPerSide * atlas->samplesPerSide);
  }
  chosen.samples = std::move(samples);
  return chosen;
}

ViewCase makeViewCase(const StudySpec& study, const LimitSurface& surface, const BaseCase& base,
                      const SamplesPass& pass, const ViewSpec& spec, Cache& cache,
                      const ContentKey& key) {
  const auto* atlas = std::get_if<AtlasSpec>(&spec.kind);
  ViewCase view;
  view.view = atlas != nullptr ? atlasView(surface, atlas->samplesPerSide)
                               : cameraView(std::get<Camera>(spec.kind), base.mesh);
  requireRoom(study, view.view, spec.name);
  ChosenSamples chosen = cache.remember(key, [&] {
    return chooseSamples(study, surface, view.view, pass.render(view.view, base.gpu), spec);
  });
  view.samples = std::move(chosen.samples);
  view.layout = std::move(chosen.layout);
  view.weights = std::move(chosen.weights);
  return view;
}

BaseCase undisplacedCase(const StudySpec& study, const LimitSurface& surface,
                         const MeshChoice& choice) {
  BaseMesh mesh =
      makeBaseMesh(surface, study.relief.texelsPerUv(), choice.subdivisions, choice.curvature);
  GpuMesh gpu(mesh);
  const RenderView texture = textureView(mesh);
  return {choice, std::move(mesh), std::move(gpu), std::nullopt, texture, {}};
}

BaseCase displacedCase(const StudySpec& study, const LimitSurface& surface,
                       const MeshChoice& choice) {
  DisplacedMesh displaced = makeDisplacedMesh(surface, study.relief, choice.subdivisions);
  GpuMesh gpu(displaced.mesh);
  GpuVolumes volumes(displaced);
  const RenderView texture = textureView(displaced.mesh);
  return {choice, std::move(displaced.mesh), std::move(gpu), std::move(volumes), texture, {}};
}

}  // namespace

BaseCase makeBaseCase(const StudySpec& study, const LimitSurface& surface, MeshChoice choice,
                      const std::filesystem::path& shaders, Cache& cache, const RunKeys& keys) {
  BaseCase base = choice.kind == DrawnMesh::displaced ? displacedCase(study, surface, choice)
                                                      : undisplacedCase(study, surface, choice);
  const SamplesPass pass(shaders);
  for (std::size_t v = 0; v < study.views.size(); ++v) {
    base.views.push_back(
        makeViewCase(study, surface, base, pass, study.views[v], cache, keys.samples(choice, v)));
  }
  return base;
}

}  // namespace gnomon
