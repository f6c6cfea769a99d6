#pragma once

#include <filesystem>
#include <vector>

#include "render/gpu_scene.h"
#include "render/view.h"
#include "study/study_file.h"
#include "surface/base_mesh.h"
#include "surface/limit_surface.h"
#include "surface/sample_grid.h"
#include "truth/shadow_tracer.h"

namespace gnomon {

/// The samples that one view of one base mesh chooses.
struct ViewCase {
  RenderView view;
  SampleGrid samples;
  std::vector<double> weights;  ///< world area of each sample in an atlas; empty for a camera
  std::vector<Truth> truths;    ///< one a light, filled by the run
};

/// A base mesh and the study's views of it. Methods that draw another base mesh than the study's
/// show other samples in a camera view, so each has views and truths of its own.
struct BaseCase {
  BaseMesh mesh;
  GpuMesh gpu;
  std::vector<ViewCase> views;  ///< as the study lists them
};

/// Builds the base mesh of `subdivisions` pieces of every face's side, and chooses the samples of
/// every view.
/// @throws InputError for a view that is larger than OpenGL allows or shows no surface; MemoryError
///   for one whose samples, truths and masks cannot be held
BaseCase makeBaseCase(const StudySpec& study, const LimitSurface& surface, int subdivisions,
                      const std::filesystem::path& shaders);

}  // namespace gnomon
