#include "common/vec.h"

#include <cmath>

namespace gnomon {

double degreesOf(double angle) {
  const double near = angle * 180 / pi;
  double scale = 1;
  for (int digits = 0; digits <= 12; ++digits, scale *= 10) {
    const double shorter = std::round(near * scale) / scale;
    if (radians(shorter) == angle) return shorter;
  }
  for (const double far : {near - 1, near + 1}) {
    double next = near;
    for (int step = 0; step < 4; ++step, next = std::nextafter(next, far)) {
      if (radians(next) == angle) return next;
    }
  }
  return near;
}

}  // namespace gnomon
