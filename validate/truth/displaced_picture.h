#pragma once

#include <vector>

#include "common/camera.h"
#include "common/progress.h"
#include "common/raw_vector.h"
#include "truth/micro_scene.h"

namespace gnomon::truth {

/// What the displaced surface looks like by its own primary rays: the picture that Figure 8(c)
/// stands for. For looking at, never for scoring: its pixels show other points than the samples do.
/// Per pixel max(0, facet normal · light) where the light reaches it, 0 where it does not, and -1
/// where the ray meets nothing. Row 0 is the top.
std::vector<float> displacedPicture(const MicroMesh& mesh, const MicroScene& scene,
                                    const Camera& camera, const Vec3& light,
                                    const Progress& progress = {});

/// Where a camera's primary rays meet the displaced surface, whatever the light.
struct SeenSurface {
  /// A pixel's.
  struct Point {
    Facet facet;
    bool isThere;
  };
  int width = 0;
  int height = 0;
  double rayOffset = 0;  ///< of shadow rays from there, world length
  RawVector<Point> points;
};

SeenSurface seenSurface(const MicroMesh& mesh, const MicroScene& scene, const Camera& camera,
                        const Progress& progress = {});

/// The picture from these, for lights that come one after the other.
std::vector<float> displacedPicture(const SeenSurface& seen, const MicroScene& scene,
                                    const Vec3& light, const Progress& progress = {});

}  // namespace gnomon::truth
