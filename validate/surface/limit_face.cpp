#include "surface/limit_face.h"

namespace gnomon::surface {
namespace {

/// The cubic with these values and derivatives at 0 and at 1.
std::array<Vec3, 4> cubicOf(const Vec3& value0, const Vec3& slope0, const Vec3& value1,
                            const Vec3& slope1) {
  const Vec3 rise = value1 - value0;
  return {value0, slope0, 3.0 * rise - 2.0 * slope0 - slope1, slope0 + slope1 - 2.0 * rise};
}

Vec3 valueAt(const std::array<Vec3, 4>& cubic, double x) {
  return cubic[0] + x * (cubic[1] + x * (cubic[2] + x * cubic[3]));
}

Vec3 firstDerivative(const std::array<Vec3, 4>& cubic, double x) {
  return cubic[1] + x * (2.0 * cubic[2] + x * (3.0 * cubic[3]));
}

Vec3 secondDerivative(const std::array<Vec3, 4>& cubic, double x) {
  return 2.0 * cubic[2] + x * (6.0 * cubic[3]);
}

}  // namespace

LimitFace::LimitFace(const LimitSurface& surface, int face, std::size_t points)
    : surface_(&surface), face_(face), bicubic_(points > 10 && surface.isBicubic(face)) {
  if (!bicubic_) return;
  const std::array corners = {surface.evaluate(face, 0, 0), surface.evaluate(face, 1, 0),
                              surface.evaluate(face, 1, 1), surface.evaluate(face, 0, 1)};
  const auto& [p00, p10, p11, p01] = corners;
  // Along s at t = 0 and t = 1: the position and its derivative by t.
  const Cubic near = cubicOf(p00.position, p00.ds, p10.position, p10.ds);
  const Cubic nearDt = cubicOf(p00.dt, p00.dst, p10.dt, p10.dst);
  const Cubic far = cubicOf(p01.position, p01.ds, p11.position, p11.ds);
  const Cubic farDt = cubicOf(p01.dt, p01.dst, p11.dt, p11.dst);
  for (std::size_t i = 0; i < 4; ++i) {
    const Cubic alongT = cubicOf(near[i], nearDt[i], far[i], farDt[i]);
    for (std::size_t j = 0; j < 4; ++j) rows_[j][i] = alongT[j];
  }
  for (std::size_t k = 0; k < 4; ++k) uvs_[k] = corners[k].uv;
}

TangentPoint LimitFace::at(double s, double t) const {
  TangentPoint point;
  row(t, {&s, 1}, {&point, 1});
  return point;
}

LimitPoint LimitFace::evaluate(double s, double t) const {
  if (!bicubic_) return surface_->evaluate(face_, s, t);
  Cubic curve, curveDt, curveDtt;
  for (std::size_t i = 0; i < 4; ++i) {
    const Cubic alongT = {rows_[0][i], rows_[1][i], rows_[2][i], rows_[3][i]};
    curve[i] = valueAt(alongT, t);
    curveDt[i] = firstDerivative(alongT, t);
    curveDtt[i] = secondDerivative(alongT, t);
  }
  return {at(s, t), secondDerivative(curve, s), firstDerivative(curveDt, s), valueAt(curveDtt, s)};
}

void LimitFace::row(double t, std::span<const double> s, std::span<TangentPoint> points) const {
  if (!bicubic_) {
    for (std::size_t k = 0; k < s.size(); ++k) {
      points[k] = surface_->tangentPoint(face_, s[k], t);
    }
    return;
  }
  Cubic curve, curveDt;
  for (std::size_t i = 0; i < 4; ++i) {
    const Cubic alongT = {rows_[0][i], rows_[1][i], rows_[2][i], rows_[3][i]};
    curve[i] = valueAt(alongT, t);
    curveDt[i] = firstDerivative(alongT, t);
  }
  const auto& [uv0, uv1, uv2, uv3] = uvs_;
  const Vec2 uvDs = (1 - t) * (uv1 - uv0) + t * (uv2 - uv3);
  for (std::size_t k = 0; k < s.size(); ++k) {
    const double x = s[k];
    points[k] = {valueAt(curve, x),
                 firstDerivative(curve, x),
                 valueAt(curveDt, x),
                 (1 - t) * ((1 - x) * uv0 + x * uv1) + t * ((1 - x) * uv3 + x * uv2),
                 uvDs,
                 (1 - x) * (uv3 - uv0) + x * (uv2 - uv1)};
  }
}

std::vector<LimitFace> limitFaces(const LimitSurface& surface, std::size_t points) {
  const auto count = static_cast<std::size_t>(surface.faceCount());
  std::vector<LimitFace> faces;
  faces.reserve(count);
  for (int face = 0; face < surface.faceCount(); ++face) {
    faces.emplace_back(surface, face, points / count);
  }
  return faces;
}

}  // namespace gnomon::surface
