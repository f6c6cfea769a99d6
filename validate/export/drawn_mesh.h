#pragma once

#include <string>

#include "report/run_folder.h"
#include "study/run/scene/run_scene.h"
#include "study/run/truth_study.h"
#include "study/spec/file_names.h"

namespace gnomon::exporting {

/// The displaced surface as a camera draws it: what a path tracer's own primary rays meet. These
/// are other points than the samples, and no score is made of them.

/// `drawn/samples/VIEW.exr` and `drawn/masks/VIEW_LIGHT_truth.png`.
std::string drawnMapFile(const study::CaseNames& names, std::size_t view);
std::string drawnMaskFile(const study::CaseNames& names, std::size_t view, std::size_t light);

/// Writes, for every camera, where the primary ray of each pixel's centre meets the truth's
/// surface, and under every light whether that point is lit. Channels, all 0 where the ray meets
/// nothing:
///   point.X, .Y, .Z   the point, world
///   facet.X, .Y, .Z   normal of the facet that holds it, unit, outward
void writeDrawnMesh(report::RunFolder& folder, const study::RunScene& scene,
                    const study::TracedSurface& surface);

}  // namespace gnomon::exporting
