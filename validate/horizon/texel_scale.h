#pragma once

#include "common/vec.h"
#include "relief/relief.h"
#include "surface/limit_surface.h"

namespace gnomon::horizon {

/// The size of a surface's texels in the world.
struct TexelScale {
  /// T, a texel's width on average, world: T² = area of the surface / area of its texture in
  /// texels, over the faces that have a texel frame. 0 if none has.
  double width = 0;
  double farthest = 0;  ///< greatest coordinate of the surface by magnitude, world
};

/// By the midpoint rule, with some 16,384 points on all faces together and at least one on each.
/// @param texelsPerUv  repeats × map size: texels that one unit of u and of v spans
/// @throws InputError where floats, in which rays and shaders compute with world units, cannot hold
///   the surface: a texel narrower than 1e-7 or wider than 1e7, whose width's fourth power they
///   have no digits for, or points so far from the origin that they are over 1/64 texel apart
TexelScale texelScale(const surface::LimitSurface& surface, Vec2 texelsPerUv);

/// The frame in which angles of the flat relief are taken: the texture's own plane, in texels, over
/// which a height unit is k texels high. A table of slopes needs no such choice, since a slope is
/// scaled where it is read; an angle cannot be, and a table that is laid over the whole surface has
/// one frame for all of it. So a light is brought into this frame and compared there (Sloan &
/// Cohen 2000, §2; Kautz, Heidrich & Daubert 2000).
/// @return k: 1 where heights are texels, and where no texel has a width. Where heights are world
///   units it is 1 / T, so that the frame is the world's own wherever texels are squares of that
///   width.
double texelsPerHeight(relief::HeightSpace space, const TexelScale& scale);

}  // namespace gnomon::horizon
