#pragma once

#include "common/vec.h"
#include "relief/height_field.h"
#include "surface/cage/cage.h"
#include "surface/limit_surface.h"
#include "surface/texel_frame.h"

namespace gnomon::relief {

/// What a height unit is in the world.
enum class HeightSpace {
  world,    ///< heights are world units: a = 1
  texture,  ///< heights are texels: a = |P_x × P_y|^½, Max's third axis N / |N|^½ (Max 1988)
};

/// A height field on a surface.
struct Relief {
  HeightField field;
  HeightSpace space = HeightSpace::world;
  Vec2 repeats{1, 1};  ///< times that the map is laid over one unit of u and of v
  /// Texels of `field` along the side of one texel of the study's own map, in which a study counts
  /// lengths.
  int resample = 1;

  /// Texels that one unit of u and of v spans: repeats × map size.
  [[nodiscard]] Vec2 texelsPerUv() const { return repeats * Vec2(field.width(), field.height()); }
};

/// a: world length per height unit at a frame.
double worldPerHeight(HeightSpace space, const surface::TexelFrame& frame);

/// D = P + a h n: the displaced point above a frame, n the frame's direction. An undefined frame is
/// not displaced.
Vec3 displaced(const Relief& relief, const surface::TexelFrame& frame);

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
