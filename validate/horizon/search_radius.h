#pragma once

#include <cstddef>
#include <span>

#include "common/vec.h"
#include "relief/relief.h"
#include "surface/limit_surface.h"

namespace gnomon::horizon {

/// Which rule determined a search radius.
enum class RadiusBound {
  stated,       ///< the study's own `bake.radius`
  leaves,       ///< the ray to the light has left the highest bump
  border,       ///< it never does; the relief ends
  quarterTurn,  ///< it never does; the surface has turned by 90°
  size,         ///< it never does; nothing is farther on a surface of this size
  tile,         ///< it never does; a map that repeats has been seen whole
  unlit,        ///< no light reaches the surface
};

/// How far occluders are searched: D of a bake, and where marches end.
struct SearchRadius {
  double texels = 1;
  RadiusBound bound = RadiusBound::unlit;
  std::size_t light = 0;  ///< that the bound is of
};

/// The rule by which a study's radius is chosen where it states none: the longest shadow that its
/// lights can cast, and not past the border.
///
/// On a regular grid of some 16,384 points over all faces, each as if the lowest texel were there:
/// how far the ray to the light goes, along the map, until it has left the highest texel for good.
/// The ground follows the circle of the surface's exact normal curvature κ toward the light. With
/// the heights h₀ and h₁ in world units, γ = κt and the light's slope tan θ,
///   (1 + κh₁) cos(γ + θ) = (1 + κh₀) cos θ   (Δh / tan θ = t on a plane).
/// In a bowl there is a second solution: the ground has come up again. A ray goes no farther than
/// the relief is known (`HeightField::knownLength`), than a quarter turn of the circle, and than
/// the diagonal of the surface's box. If it has not left by then, or the ground has come up again,
/// it never leaves: then it is followed to the nearest of these ends, or over the diagonal of the
/// map where that is less. Points that the light does not reach at all are left out: those whose
/// highest bump is beyond the bare surface's horizon (`bareHorizon`), or on a surface that is not
/// convex those turned from it.
///
/// The result is the largest over all points and lights, rounded up, 1 to 16,384 texels. It depends
/// on no view.
/// @param lights  unit vectors toward them
SearchRadius searchRadius(const surface::LimitSurface& surface, const relief::Relief& relief,
                          std::span<const Vec3> lights);

/// Input of `endOf`: a ray over the relief, and the lengths that may bound it.
struct RayWay {
  double curvature;  ///< κ toward the light, 1 / world, convex positive
  double slope;      ///< tan θ
  double lowest;     ///< h₀, world
  double highest;    ///< h₁ ≥ h₀, world
  double border;     ///< where the relief is no longer known, world; infinite without a border
  double size;       ///< diagonal of the surface's box, world
  double tile;       ///< diagonal of the map, world
};

/// The distance at which a ray has left the relief for good, world, and the bound that determines
/// it; `unlit` and 0 where no light arrives whatever the relief is.
struct RayEnd {
  double distance;
  RadiusBound bound;
};

RayEnd endOf(const RayWay& way);

}  // namespace gnomon::horizon
