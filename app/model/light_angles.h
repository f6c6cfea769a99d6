#pragma once

#include "study/spec/study_file.h"

namespace gnomon::app {

/// A light as it is dragged and saved, in degrees, so that a study file holds it to the bit.
struct LightAngles {
  double azimuth = 0;     ///< counter-clockwise from +x about +z, [0, 360) after a drag
  double elevation = 45;  ///< over the xy plane, -90 to 90
  double radius = 0;      ///< of its disc, 0 to study::largestLightRadius; 0 is a point
  friend bool operator==(const LightAngles&, const LightAngles&) = default;
};

LightAngles lightAngles(const study::LightSpec& light);

/// The light that a study file with these angles has, named as it names it.
study::LightSpec lightSpec(const LightAngles& angles);

/// A light dragged by some degrees: the azimuth wraps, the elevation ends at the poles. Rounded to
/// a thousandth of a degree, so that dragging back returns.
LightAngles dragged(const LightAngles& angles, double azimuthChange, double elevationChange);

}  // namespace gnomon::app
