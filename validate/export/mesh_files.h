#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "displaced/displaced_mesh.h"
#include "report/run_folder.h"
#include "study/run/run_study.h"
#include "study/run/scene/run_scene.h"
#include "study/spec/sections/study_files.h"
#include "surface/base_mesh.h"
#include "truth/micro_mesh.h"

namespace gnomon::exporting {

/// Writes the triangles as a binary PLY (in this machine's byte order, which the header states):
/// `float x y z` a vertex, `uchar int int int` a face. Whole or not at all.
/// @throws InputError when the file cannot be written
void writePly(const std::filesystem::path& file, const displaced::WeldedMesh& mesh,
              const std::string& comment);

/// Writes the triangles as a Wavefront OBJ, each vertex with its own `vt` (uv) and `vn`, in floats
/// as the rasteriser gets them, with every digit. Whole or not at all.
/// @param texelsPerUv  as in texelFrame
/// @throws InputError when the file cannot be written
void writeObj(const std::filesystem::path& file, const surface::BaseMesh& mesh, Vec2 texelsPerUv,
              const std::string& comment);

/// The displaced surface as a camera draws it: what a path tracer's own primary rays meet. These
/// are other points than the samples, and no score is made of them.

/// `drawn/samples/VIEW.exr`, `drawn/masks/VIEW_LIGHT_truth.png` and, of a light with a disc,
/// `drawn/shares/VIEW_LIGHT_truth.exr`.
std::string drawnMapFile(const study::CaseNames& names, std::size_t view);
std::string drawnMaskFile(const study::CaseNames& names, std::size_t view, std::size_t light);
std::string drawnShareFile(const study::CaseNames& names, std::size_t view, std::size_t light);

/// The answers at those points, [view][light]: masks, and of lights with discs shares. None in the
/// view of an atlas. Regions are not found.
using DrawnTruths = std::vector<std::vector<truth::Truth>>;

/// Writes, for every camera, where the primary ray of each pixel's centre meets the truth's
/// surface, and under every light whether that point is lit, as `writeTruthMask`. Channels, all 0
/// where the ray meets nothing:
///   point.X, .Y, .Z   the point, world
///   facet.X, .Y, .Z   normal of the facet that holds it, unit, outward
DrawnTruths writeDrawnMesh(report::RunFolder& folder, const study::RunScene& scene,
                           const study::TracedSurface& surface);

/// Their uncertainty, [view][light]: `truth::uncertaintyOf` of them and of what the same primary
/// rays meet on the surface at half the resolution, with half the offset of shadow rays and half as
/// many directions, over the pixels where both meet something.
std::vector<std::vector<double>> drawnUncertainties(const study::RunScene& scene,
                                                    const study::TracedSurface& coarse,
                                                    const DrawnTruths& drawn);

/// How far the exported mesh is from the truth's: between the two points above the same (face, s,
/// t), over the samples of all views of the standard base.
struct MeshDistance {
  std::size_t samples = 0;
  double largest = 0, mean = 0;              ///< world length
  double largestTexels = 0, meanTexels = 0;  ///< over a texel's length there, |P_x × P_y|^½
};

/// @param pieces  subdivisions of the exported mesh
MeshDistance meshDistance(study::RunScene& scene, const truth::MicroMesh& truth,
                          const displaced::WeldedMesh& exported, int pieces);

}  // namespace gnomon::exporting
