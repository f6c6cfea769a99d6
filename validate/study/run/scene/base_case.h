#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "cache/cache.h"
#include "common/parallel.h"
#include "compare/answer_metrics.h"
#include "render/gpu_scene.h"
#include "render/method.h"
#include "study/run/scene/run_keys.h"
#include "study/spec/study_file.h"
#include "surface/base_mesh.h"
#include "surface/limit_surface.h"
#include "surface/sample_grid.h"
#include "surface/texture_layout.h"
#include "truth/shadow_tracer.h"

namespace gnomon::study {

/// The samples that one view of one base mesh chooses.
struct ViewCase {
  render::RenderView view;
  surface::SampleGrid samples;
  compare::SampleLayout layout;      ///< how they lie beside each other
  std::vector<double> weights;       ///< world area of each sample in an atlas; empty for a camera
  std::vector<truth::Truth> truths;  ///< one a light, filled by the run
};

/// A mesh as it is drawn.
struct DrawnBase {
  surface::BaseMesh mesh;
  render::GpuMesh gpu;
  std::optional<render::GpuVolumes> volumes;  ///< of a displaced mesh
  render::RenderView texture;                 ///< the texture's own plane
};

/// A mesh and the study's views of it. Methods that draw another mesh than the study's base show
/// other samples in a camera view, so each has views and truths of its own: the truth is asked at
/// the (face, s, t) of the very pixels that the method draws. In an atlas all show the same
/// samples.
struct BaseCase {
  MeshChoice choice;
  /// Made only where something has to be drawn.
  OnDemand<std::shared_ptr<const DrawnBase>> drawn;
  std::vector<ViewCase> views;  ///< as the study lists them
};

/// What a base case is made with.
struct CaseMakers {
  const std::filesystem::path& shaders;
  cache::Cache& cache;
  const RunKeys& keys;
  const surface::TextureLayout& layout;  ///< of the surface
};

/// A mesh that is made, or taken from the cache, when it is first asked for.
/// @param study  outlives it, as do `surface` and `with`'s
OnDemand<std::shared_ptr<const DrawnBase>> drawnOnDemand(const StudySpec& study,
                                                         const surface::LimitSurface& surface,
                                                         MeshChoice choice, CaseMakers with);

/// Chooses the samples of every view by drawing the mesh, or takes what the cache has of them.
/// @param study    outlives the case, as do `surface` and `with`'s
/// @throws InputError for a view that is larger than OpenGL allows or shows no surface; MemoryError
///   for one whose samples, truths and masks do not fit in memory
BaseCase makeBaseCase(const StudySpec& study, const surface::LimitSurface& surface,
                      MeshChoice choice, CaseMakers with);

}  // namespace gnomon::study
