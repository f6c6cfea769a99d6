#pragma once

#include <string>

#include "common/camera.h"
#include "common/light.h"

namespace gnomon::app {

/// A light dragged by some degrees: the azimuth wraps to [0, 360), the elevation ends at the poles.
/// Rounded to a thousandth of a degree, so that dragging back returns.
LightAngles dragged(const LightAngles& angles, double azimuthChange, double elevationChange);

/// A path of the light, frame by frame: azimuth and elevation both change evenly from a start to an
/// end. Azimuths are taken as they are written, so 350 to 370 passes north and 350 to 10 does not.
/// A path of whole turns that ends where it began leaves its last frame out, so that a film of it
/// repeats without a jump.
struct LightPath {
  double fromAzimuth = 0, fromElevation = 45;  ///< of the first frame, degrees
  double toAzimuth = 360, toElevation = 45;    ///< of the end, degrees
  int frames = 48;                             ///< 1 and more
  friend bool operator==(const LightPath&, const LightPath&) = default;
};

/// The light of a frame: t = frame / (frames - 1) of the way, of a closed path frame / frames.
/// Rounded to a thousandth of a degree as a dragged light is.
/// @param frame   0 to frames - 1
/// @param radius  of its disc, degrees
LightAngles lightAt(const LightPath& path, int frame, double radius);

/// "around", or "AZIMUTH,ELEVATION,AZIMUTH,ELEVATION" of start and end.
/// @param light  where a turn starts, once around at its elevation
/// @throws UsageError for another text, for an elevation beyond ±90° and an azimuth beyond ±3600°
LightPath parsePath(const std::string& text, const LightAngles& light, int frames);

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
