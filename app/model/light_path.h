#pragma once

#include <optional>
#include <string>

#include "model/light_angles.h"

namespace gnomon::app {

/// A path of the light, frame by frame: azimuth and elevation both change evenly from a start to an
/// end. Azimuths are taken as they are written, so 350 to 370 passes north and 350 to 10 does not.
/// A path of whole turns that ends where it began leaves its last frame out, so that a film of it
/// repeats without a jump.
struct LightPath {
  double fromAzimuth = 0, fromElevation = 45;  ///< of the first frame, degrees
  double toAzimuth = 360, toElevation = 45;    ///< of the end, degrees
  int frames = 48;                             ///< 1 to mostPathFrames
  friend bool operator==(const LightPath&, const LightPath&) = default;
};

constexpr int mostPathFrames = 9999;
constexpr int pathFramesPerSecond = 12;  ///< as it is played, and in films

/// Whether its end is its start after whole turns.
bool isClosed(const LightPath& path);

/// The light of a frame: t = frame / (frames - 1) of the way, of a closed path frame / frames.
/// Rounded to a thousandth of a degree as a dragged light is.
/// @param frame   0 to frames - 1
/// @param radius  of its disc, degrees
LightAngles lightAt(const LightPath& path, int frame, double radius);

/// The frame that is shown so long after the start; none once the path has ended.
std::optional<int> frameAt(const LightPath& path, double seconds);

/// Once around, at a light's elevation, from its azimuth.
LightPath turnFrom(const LightAngles& light, int frames);

/// The path that ends at a light; the azimuth goes the shorter way.
LightPath withEnd(const LightPath& path, const LightAngles& light);

/// "around", or "AZIMUTH,ELEVATION,AZIMUTH,ELEVATION" of start and end.
/// @param light  where a turn starts
/// @throws UsageError for another text, for an elevation beyond ±90° and an azimuth beyond ±3600°
LightPath parsePath(const std::string& text, const LightAngles& light, int frames);

/// "once around from 165° at elevation 24°", "from azimuth 165°, elevation 24° to 20°, 60°".
std::string pathText(const LightPath& path);

}  // namespace gnomon::app
