#pragma once

#include <vector>

#include "common/camera.h"
#include "common/progress.h"
#include "truth/micro_scene.h"

namespace gnomon {

/// What the displaced surface looks like by its own primary rays: the picture that Figure 8(c)
/// stands for. For looking at, never for scoring: its pixels show other points than the samples do.
/// Per pixel max(0, facet normal · light) where the light reaches it, 0 where it does not, and -1
/// where the ray meets nothing. Row 0 is the top.
std::vector<float> displacedPicture(const MicroMesh& mesh, const MicroScene& scene,
                                    const Camera& camera, const Vec3& light,
                                    const Progress& progress = {});

}  // namespace gnomon
