#pragma once

#include "common/vec.h"
#include "surface/limit_surface.h"

namespace gnomon::surface {

/// The frame in which a bump map lives at one point of a surface: texture coordinates in texels and
/// the world vectors per texel, by the chain rule P_s = P_x x_s + P_y y_s (and so for t).
struct TexelFrame {
  Vec3 position;  ///< P, world
  /// n, unit, the surface's outward side whatever the texture's handedness: shadingNormal.
  Vec3 normal;
  Vec3 px, py;  ///< P_x, P_y: world length per texel
  Vec2 texel;   ///< (x, y) in texels: uv × texelsPerUv
  /// False where the surface or the texture map is degenerate (directions within 1e-12 of parallel,
  /// or one 1e12 times as long as the other): P_x and P_y are then zero.
  bool defined;
  /// In which the point is displaced, unit; zero where that is `normal`, as on a limit surface.
  Vec3 ownDirection{0};

  [[nodiscard]] const Vec3& direction() const {
    return ownDirection == Vec3(0) ? normal : ownDirection;
  }
};

/// Where the point has a normal of its own, P_x and P_y are turned by the rotation that takes
/// outwardNormal there by the shortest way: in the plane of shading they have the lengths and the
/// angle that they have on the polygon, so that the metric, σ and a are the polygon's.
/// @param texelsPerUv  repeats × map size: texels that one unit of u and of v spans
TexelFrame texelFrame(const TangentPoint& point, Vec2 texelsPerUv);

/// The frame of the surface itself: n is outwardNormal, and P_x and P_y are tangents, whatever the
/// point is shaded with.
TexelFrame tangentFrame(const TangentPoint& point, Vec2 texelsPerUv);

/// The light as horizon methods see it from one frame.
struct LocalLight {
  Vec2 direction;        ///< e: unit vector of the light's azimuth in the texture plane (texels)
  double worldPerTexel;  ///< σ = |e_x P_x + e_y P_y|: world length of one texel along e
  double slope;          ///< tan θ = (L·n) / |L - (L·n) n|: elevation over the tangent plane

  /// φ = atan2(e_y, e_x), radians.
  [[nodiscard]] double azimuth() const;
};

/// Solves L = ℓ_x P_x + ℓ_y P_y + c n for ℓ by the 2 × 2 metric system, since P_x and P_y need be
/// neither orthogonal nor equally long. A light along the normal has direction (1, 0) and slope
/// ±infinity.
/// @param light  L, unit vector toward the light; the frame must be defined
LocalLight localLight(const TexelFrame& frame, const Vec3& light);

}  // namespace gnomon::surface
