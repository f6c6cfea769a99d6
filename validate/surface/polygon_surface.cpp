#include "surface/polygon_surface.h"

#include "common/error.h"

namespace gnomon::surface {
namespace {

/// A bilinear function of (s, t) and its derivatives.
struct Bilinear {
  Vec3 value, ds, dt, dst;

  Bilinear(const std::vector<Vec3>& values, const std::array<int, 4>& corners, double s, double t) {
    const auto at = [&](std::size_t k) { return values[static_cast<std::size_t>(corners.at(k))]; };
    const Vec3 a = at(0), b = at(1), c = at(2), d = at(3);
    value = (1 - t) * ((1 - s) * a + s * b) + t * ((1 - s) * d + s * c);
    ds = (1 - t) * (b - a) + t * (c - d);
    dt = (1 - s) * (d - a) + s * (c - b);
    dst = (c - d) - (b - a);
  }
};

/// Zero where vectors cancel each other.
Vec3 directionOf(const Vec3& vector) {
  const double length = glm::length(vector);
  return length > 1e-9 ? vector / length : Vec3(0);
}

/// The derivative of v / |v| by that of v.
Vec3 unitDerivative(const Vec3& vector, const Vec3& derivative) {
  const double length = glm::length(vector);
  if (!(length > 1e-9)) return Vec3(0);
  const Vec3 along = vector / length;
  return (derivative - glm::dot(derivative, along) * along) / length;
}

std::vector<std::array<int, 4>> byFaces(const std::vector<int>& corners) {
  std::vector<std::array<int, 4>> faces;
  faces.reserve(corners.size() / 4);
  for (std::size_t k = 0; k + 3 < corners.size(); k += 4) {
    faces.push_back({corners[k], corners[k + 1], corners[k + 2], corners[k + 3]});
  }
  return faces;
}

}  // namespace

PolygonSurface::PolygonSurface(const Cage& cage)
    : positions_(cage.positions),
      directions_(cage.directions),
      normals_(cage.normals),
      faceVertices_(byFaces(cage.faceVertices)),
      faceNormals_(byFaces(cage.faceNormals)) {
  if (directions_.size() != positions_.size() || faceNormals_.size() != faceVertices_.size()) {
    throw InternalError("polygons without their normals: makePolygonCage makes them");
  }
}

TangentPoint PolygonSurface::tangentPoint(std::size_t face, double s, double t) const {
  const Bilinear position(positions_, faceVertices_[face], s, t);
  TangentPoint point;
  point.position = position.value;
  point.ds = position.ds;
  point.dt = position.dt;
  point.ownNormal = directionOf(Bilinear(normals_, faceNormals_[face], s, t).value);
  point.ownDirection = directionOf(Bilinear(directions_, faceVertices_[face], s, t).value);
  return point;
}

LimitPoint PolygonSurface::evaluate(std::size_t face, double s, double t) const {
  LimitPoint point;
  static_cast<TangentPoint&>(point) = tangentPoint(face, s, t);
  point.dss = Vec3(0);
  point.dst = Bilinear(positions_, faceVertices_[face], s, t).dst;
  point.dtt = Vec3(0);
  const Bilinear normal(normals_, faceNormals_[face], s, t);
  point.ownNormalDs = unitDerivative(normal.value, normal.ds);
  point.ownNormalDt = unitDerivative(normal.value, normal.dt);
  return point;
}

}  // namespace gnomon::surface
