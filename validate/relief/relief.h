#pragma once

#include "common/vec.h"
#include "relief/height_field.h"
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

}  // namespace gnomon::relief
