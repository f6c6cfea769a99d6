#pragma once

#include "common/vec.h"

namespace gnomon::study {

/// Sine and cosine of an angle in degrees, the same bits on every machine: by their series, with +
/// and × alone. Err by less than 1e-15. A library's own may differ in the last bit.
struct SineCosine {
  double sine, cosine;
};
SineCosine sineCosine(double degrees);

/// The unit vector at an elevation over the xy plane and an azimuth from +x about +z, degrees.
Vec3 exactDirection(double elevation, double azimuth);

}  // namespace gnomon::study
