#pragma once

#include <string>

#include "common/vec.h"

namespace gnomon {

/// The angles of a light as they are given, degrees, so that a study file holds them to the bit.
struct LightAngles {
  double azimuth = 0;     ///< counter-clockwise from +x about +z
  double elevation = 45;  ///< over the xy plane, -90 to 90
  double radius = 0;      ///< of its disc; 0 is a point
  friend bool operator==(const LightAngles&, const LightAngles&) = default;
};

/// A light so far away that it lies in the same direction everywhere: a point, or a disc.
struct Light {
  Vec3 direction{0, 0, 1};  ///< unit vector toward it; of a disc toward its centre
  double radius = 0;        ///< ρ, the angular radius of its disc, radians; 0 for a point
  std::string name = {};
  LightAngles angles = {};

  /// Whether it is a disc, of which a point may see a share.
  [[nodiscard]] bool isSoft() const { return radius > 0; }
};

/// @param name  where it is empty, the light is named by its angles: "elevation 24° azimuth 165°";
///              of a disc by its radius too, "elevation 24° azimuth 165° radius 0.266°"
Light makeLight(const LightAngles& angles, const std::string& name = {});

}  // namespace gnomon
