#include "surface/curvature.h"

#include <algorithm>
#include <cmath>

namespace gnomon::surface {
namespace {

/// The unit tangential part of a vector, along e1 and e2; zero where that vanishes.
Vec2 tangentOf(const ShapeOperator& shape, const Vec3& direction) {
  const Vec2 parts(glm::dot(direction, shape.e1), glm::dot(direction, shape.e2));
  const double tangential = std::hypot(parts.x, parts.y);
  return tangential > 1e-12 * glm::length(direction) ? parts / tangential : Vec2(0);
}

}  // namespace

/// With e1 along P_s: in this frame H and √(H² - K) need no difference of large numbers.
ShapeOperator shapeOperator(const LimitPoint& point) {
  const Vec3 n = outwardNormal(point);
  if (n == Vec3(0)) return {};
  const double length = glm::length(point.ds);
  const Vec3 e1 = point.ds / length;
  const Vec3 e2 = glm::cross(n, e1);
  // P_t = a e1 + b e2, so e2 = (P_t - (a / length) P_s) / b.
  const double a = glm::dot(point.dt, e1) / length;
  const double b = glm::dot(point.dt, e2);
  double e = -glm::dot(point.dss, n);
  double f = -glm::dot(point.dst, n);
  double g = -glm::dot(point.dtt, n);
  if (point.ownNormal != Vec3(0)) {
    // By Weingarten's equations, -P_st · n = P_s · n_t = P_t · n_s; of N, which is no surface's,
    // the two differ.
    e = glm::dot(point.ds, point.ownNormalDs);
    f = (glm::dot(point.ds, point.ownNormalDt) + glm::dot(point.dt, point.ownNormalDs)) / 2;
    g = glm::dot(point.dt, point.ownNormalDt);
  }
  const double l11 = e / (length * length);
  const double l12 = (f - a * e) / (length * b);
  const double l22 = (g - 2 * a * f + a * a * e) / (b * b);
  const bool finite = std::isfinite(l11) && std::isfinite(l12) && std::isfinite(l22);
  if (!finite) return {};
  return {e1, e2, l11, l12, l22};
}

PrincipalCurvatures ShapeOperator::principal(double umbilic) const {
  const double mean = (l11 + l22) / 2;
  const double difference = (l11 - l22) / 2;
  const double radius = std::hypot(difference, l12);
  const double angle = radius > umbilic ? std::atan2(l12, difference) / 2 : 0;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {mean + radius, mean - radius, c * e1 + s * e2, c * e2 - s * e1};
}

PrincipalCurvatures principalCurvatures(const LimitPoint& point) {
  // Where the curvatures differ by less than an angle of 1e-10 over a face, the directions are
  // rounding.
  return shapeOperator(point).principal(1e-10 /
                                        std::max(glm::length(point.ds), glm::length(point.dt)));
}

double normalCurvature(const LimitPoint& point, const Vec3& direction) {
  const ShapeOperator shape = shapeOperator(point);
  const Vec2 t = tangentOf(shape, direction);
  return shape.l11 * t.x * t.x + 2 * shape.l12 * t.x * t.y + shape.l22 * t.y * t.y;
}

Vec3 applyShapeOperator(const LimitPoint& point, const Vec3& direction) {
  return applyShapeOperator(shapeOperator(point), direction);
}

Vec3 applyShapeOperator(const ShapeOperator& shape, const Vec3& direction) {
  const Vec2 t = tangentOf(shape, direction);
  return (shape.l11 * t.x + shape.l12 * t.y) * shape.e1 +
         (shape.l12 * t.x + shape.l22 * t.y) * shape.e2;
}

}  // namespace gnomon::surface
