#pragma once

#include "common/vec.h"
#include "surface/limit_surface.h"

namespace gnomon {

/// Principal curvatures of a surface, 1 / world length, *positive where the surface bends away from
/// the outward normal* (convex: +1/R on a sphere), largest first, with their unit tangent
/// directions in world space. At an umbilic, where every direction is principal, v1 is the
/// direction of P_s: finite always. Curvatures whose difference turns the normal by less
/// than 1e-10 over a face count as equal.
struct PrincipalCurvatures {
  double k1, k2;
  Vec3 v1, v2;
};

/// From the fundamental forms I = (E, F, G), II = (e, f, g): with H = (eG - 2fF + gE) / 2(EG - F²)
/// and K = (eg - f²) / (EG - F²), the curvatures are H ± √(H² - K) (do Carmo 1976, §3-3), sign
/// turned. They satisfy k1 + k2 = -2 H, k1 k2 = K, v1 × v2 = n. Where P_s × P_t vanishes all is
/// zero.
PrincipalCurvatures principalCurvatures(const LimitPoint& point);

/// κ(V) = -II(V, V) / I(V, V) for the tangential part of a world vector V; 0 where that vanishes.
/// Satisfies Euler's formula κ = k1 cos² + k2 sin² of the angle from v1.
double normalCurvature(const LimitPoint& point, const Vec3& direction);

/// S T, how the outward normal changes a world unit along T, the unit tangential part of a world
/// vector: a tangent of length |κ1 (T·v1) v1 + κ2 (T·v2) v2|, with T · S T = κ(T). On a sphere it
/// is T / R. Zero where that part vanishes.
Vec3 normalTurn(const LimitPoint& point, const Vec3& direction);

}  // namespace gnomon
