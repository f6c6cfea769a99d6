#include "surface/texel_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::surface {

TexelFrame tangentFrame(const TangentPoint& point, Vec2 texelsPerUv) {
  const Vec2 texel = point.uv * texelsPerUv;
  const Vec2 xyS = point.uvDs * texelsPerUv;
  const Vec2 xyT = point.uvDt * texelsPerUv;
  const double determinant = xyS.x * xyT.y - xyS.y * xyT.x;
  const Vec3 normal = outwardNormal(point);
  const double longer = std::max(glm::length(xyS), glm::length(xyT));
  const bool flat = !(std::abs(determinant) > 1e-12 * longer * longer);
  if (flat || normal == Vec3(0)) return {point.position, normal, Vec3(0), Vec3(0), texel, false};
  // The inverse of P_s = P_x x_s + P_y y_s, P_t = P_x x_t + P_y y_t.
  const Vec3 px = (xyT.y * point.ds - xyS.y * point.dt) / determinant;
  const Vec3 py = (xyS.x * point.dt - xyT.x * point.ds) / determinant;
  return {point.position, normal, px, py, texel, true};
}

TexelFrame texelFrame(const TangentPoint& point, Vec2 texelsPerUv) {
  TexelFrame frame = tangentFrame(point, texelsPerUv);
  if (point.ownNormal == Vec3(0) || frame.normal == Vec3(0)) return frame;
  // The rotation from n to N (Rodrigues), by axis times sine and cosine.
  const Vec3 axis = glm::cross(frame.normal, point.ownNormal);
  const double cosine = glm::dot(frame.normal, point.ownNormal);
  frame.normal = point.ownNormal;
  frame.ownDirection = point.ownDirection;
  if (!(1 + cosine > 1e-9)) {  // N is turned over: no way is the shortest
    frame.px = frame.py = Vec3(0);
    frame.defined = false;
    return frame;
  }
  const auto turned = [&](const Vec3& v) {
    const Vec3 across = glm::cross(axis, v);
    return v + across + glm::cross(axis, across) / (1 + cosine);
  };
  frame.px = turned(frame.px);
  frame.py = turned(frame.py);
  return frame;
}

double LocalLight::azimuth() const {
  return std::atan2(direction.y, direction.x);
}

LocalLight localLight(const TexelFrame& frame, const Vec3& light) {
  const double rise = glm::dot(light, frame.normal);
  const double run = glm::length(light - rise * frame.normal);
  // An angle of 1e-12 from the normal is rounding; it has no azimuth.
  if (!(run > 1e-12)) {
    return {Vec2(1, 0), glm::length(frame.px),
            std::copysign(std::numeric_limits<double>::infinity(), rise)};
  }
  const double xx = glm::dot(frame.px, frame.px);
  const double xy = glm::dot(frame.px, frame.py);
  const double yy = glm::dot(frame.py, frame.py);
  const double lightX = glm::dot(light, frame.px);
  const double lightY = glm::dot(light, frame.py);
  // Both components carry the factor 1 / (xx yy - xy²) > 0, which the unit vector does not need.
  const Vec2 direction = glm::normalize(Vec2(yy * lightX - xy * lightY, xx * lightY - xy * lightX));
  return {direction, glm::length(direction.x * frame.px + direction.y * frame.py), rise / run};
}

}  // namespace gnomon::surface
