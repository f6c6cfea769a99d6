#pragma once

#include "common/camera.h"

namespace gnomon::app {

/// A camera as a person moves it: pure functions, camera in, camera out. All keep target, up, field
/// of view and size.

/// The eye turned about the target: by `azimuth` about `up` (counter-clockwise seen from above),
/// and by `elevation` toward `up`, radians; both in one step. It keeps its distance to rounding.
/// The elevation ends 1° from the poles (or where it was, if nearer), so that the picture never
/// flips.
Camera orbited(const Camera& camera, double azimuth, double elevation);

/// How near and how far the eye may come to its target, world units; 0 < nearest ≤ farthest.
struct ZoomRange {
  double nearest;
  double farthest;
};

/// The eye's distance multiplied by a factor > 0 (below 1 comes nearer), within the range.
Camera zoomed(const Camera& camera, double factor, const ZoomRange& range);

}  // namespace gnomon::app
