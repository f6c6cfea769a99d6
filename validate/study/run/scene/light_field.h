#pragma once

#include "common/raw_vector.h"
#include "common/vec.h"
#include "compare/shadow_length.h"
#include "render/view.h"
#include "study/spec/sections/view_section.h"
#include "surface/limit_surface.h"
#include "surface/sample_grid.h"

namespace gnomon::study {

/// A sample's point of the surface, as the light fields of all lights need it.
struct FieldPoint {
  Vec3 position;
  Vec3 ds, dt;    ///< first derivatives
  Vec3 normal;    ///< outwardNormal
  float spacing;  ///< sampleSpacing, whatever the light
};

/// Those of a view's samples; undefined where there is none on the surface.
using FieldPoints = RawVector<FieldPoint>;
FieldPoints makeFieldPoints(const surface::LimitSurface& surface, const ViewKind& kind,
                            const render::RenderView& view, const surface::SampleGrid& samples);

/// The steps along which the shadows of one light are measured in one view.
///
/// At each sample, with the exact limit surface's P and n: V = -(L - (L·n) n), normalised, is the
/// direction in which shadows fall. Its image (see `ViewMap`) is how the sample's place in the
/// picture moves a world unit along V. A step of one sample is the unit vector of that image and
/// measures one over its length, in world units; foreshortening is thus undone.
///
/// Zero, that is left out, where no sample is, the undisplaced surface is turned from the light
/// (n·L ≤ 0: there a shadow has no end that an occluder gave it), the light is within 1e-6 of n,
/// the frame is degenerate, or the surface is seen edge-on.
///
/// `spacing` is `sampleSpacing`.
/// @param light  unit vector toward the light
compare::LightField makeLightField(const surface::LimitSurface& surface, const ViewKind& kind,
                                   const render::RenderView& view,
                                   const surface::SampleGrid& samples, const Vec3& light);

/// The same from the points of the samples.
compare::LightField makeLightField(const surface::LimitSurface& surface, const ViewKind& kind,
                                   const render::RenderView& view,
                                   const surface::SampleGrid& samples, const FieldPoints& points,
                                   const Vec3& light);

}  // namespace gnomon::study
