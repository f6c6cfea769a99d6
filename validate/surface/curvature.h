#pragma once

#include "common/vec.h"
#include "surface/limit_surface.h"

namespace gnomon::surface {

/// Principal curvatures of a surface, 1 / world length, *positive where the surface bends away from
/// the outward normal* (convex: +1/R on a sphere), largest first, with their unit tangent
/// directions in world space. At an umbilic, where every direction is principal, v1 is the
/// direction of P_s. Curvatures count as equal if, because of their difference, the normal changes
/// by less than 1e-10 radians over a face.
struct PrincipalCurvatures {
  double k1, k2;
  Vec3 v1, v2;
};

/// The shape operator S (Weingarten map) in an orthonormal frame of the tangent plane: the
/// symmetric matrix (l11 l12; l12 l22), whose eigenvalues are the principal curvatures, convex
/// positive.
struct ShapeOperator {
  Vec3 e1, e2;  ///< e1 × e2 = n; both zero where the surface is degenerate
  double l11, l12, l22;

  /// Eigenvalues and eigenvectors.
  /// @param umbilic  a half difference of the eigenvalues up to this counts as none: v1 is then e1
  [[nodiscard]] PrincipalCurvatures principal(double umbilic) const;
};

/// Zero where the surface is degenerate. Of a point with an own normal it is the turn of that (see
/// PolygonSurface), the mean of which and of its transpose counts.
ShapeOperator shapeOperator(const LimitPoint& point);

/// From the fundamental forms I = (E, F, G), II = (e, f, g): with H = (eG - 2fF + gE) / 2(EG - F²)
/// and K = (eg - f²) / (EG - F²), the curvatures are H ± √(H² - K) (do Carmo 1976, §3-3), with
/// the sign changed. They satisfy k1 + k2 = -2 H, k1 k2 = K, v1 × v2 = n. Where P_s × P_t vanishes,
/// all values are zero.
PrincipalCurvatures principalCurvatures(const LimitPoint& point);

/// κ(V) = -II(V, V) / I(V, V) for the tangential part of a world vector V; 0 where that part
/// vanishes. Satisfies Euler's formula κ = k1 cos² + k2 sin² of the angle from v1.
double normalCurvature(const LimitPoint& point, const Vec3& direction);

/// S T for the shape operator S: how the outward normal changes a world unit along T, the unit
/// tangential part of a world vector: a tangent of length |κ1 (T·v1) v1 + κ2 (T·v2) v2|, with T · S
/// T = κ(T). On a sphere it is T / R. Zero where that part vanishes.
Vec3 applyShapeOperator(const LimitPoint& point, const Vec3& direction);
Vec3 applyShapeOperator(const ShapeOperator& shape, const Vec3& direction);

}  // namespace gnomon::surface
