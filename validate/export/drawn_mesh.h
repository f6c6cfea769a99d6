#pragma once

#include <string>
#include <vector>

#include "report/run_folder.h"
#include "study/run/scene/run_scene.h"
#include "study/run/truth_study.h"
#include "study/spec/file_names.h"

namespace gnomon::exporting {

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

}  // namespace gnomon::exporting
