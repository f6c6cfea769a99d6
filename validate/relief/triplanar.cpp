#include "relief/triplanar.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "relief/pattern_parts.h"

namespace gnomon::relief {
namespace {

/// Zigzag between 0 and `side`: x itself from 0 to `side`, then back.
double mirrored(double x, double side) {
  const double along = x - 2 * side * std::floor(x / (2 * side));
  return along <= side ? along : 2 * side - along;
}

/// The outermost half texels hold their value: there neighbours of both sides are alike.
double mirroredAt(const HeightField& image, Vec2 place) {
  const double x = std::clamp(mirrored(place.x, image.width()), 0.5, image.width() - 0.5);
  const double y = std::clamp(mirrored(place.y, image.height()), 0.5, image.height() - 0.5);
  return image.at({x, y});
}

/// Equal weights where there is no normal.
Vec3 weightsOf(const Vec3& normal) {
  const Vec3 squares = normal * normal;
  const Vec3 powers = squares * squares;
  const double sum = powers.x + powers.y + powers.z;
  return sum > 0 ? powers / sum : Vec3(1.0 / 3);
}

}  // namespace

SurfaceFunction triplanar(HeightField image, double period) {
  requireLength("period", period);
  const double texelsPerUnit = image.width() / period;
  return [image = std::move(image), texelsPerUnit](const Vec3& point, const Vec3& normal) {
    const Vec3 place = texelsPerUnit * point;
    const Vec3 weights = weightsOf(normal);
    return weights.x * mirroredAt(image, {place.y, place.z}) +
           weights.y * mirroredAt(image, {place.z, place.x}) +
           weights.z * mirroredAt(image, {place.x, place.y});
  };
}

}  // namespace gnomon::relief
