#pragma once

#include "relief/height_field.h"
#include "surface/cage/cage.h"
#include "surface/limit_surface.h"

namespace gnomon::relief {

/// The axes along which a map ends with the surface that carries it.
///
/// Along an axis there is a border where the map is laid at most once over the surface (texture
/// coordinates times repeats lie in [0, 1]) and
///   the map is clamped: its author says that it ends; or
///   the map repeats, and the surface is a grid that is open there, as a patch is and a torus is
///   not.
/// A map that is laid more than once over an open patch has no border: its tables describe one tile
/// and cannot know in which tile the surface ends.
/// @param surface  of the cage
/// @param repeats  times that the map is laid over one unit of u and of v
Border borderOf(const surface::Cage& cage, const surface::LimitSurface& surface, Wrap wrap,
                Vec2 repeats);

/// The wrap of a map whose study names none: `clamp` on a mesh from a file that is open and that
/// the map is laid over at most once, since what `repeat` puts past its border is not there;
/// `repeat` elsewhere. A built-in shape that is open has its border under either (borderOf).
Wrap defaultWrap(const surface::Cage& cage, Vec2 repeats);

}  // namespace gnomon::relief
