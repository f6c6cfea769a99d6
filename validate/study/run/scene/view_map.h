#pragma once

#include "common/raw_vector.h"
#include "common/vec.h"
#include "compare/mask_metrics.h"
#include "compare/shadow_length.h"
#include "render/gpu_scene.h"
#include "study/spec/sections/view_section.h"
#include "surface/limit_surface.h"
#include "surface/sample_grid.h"

namespace gnomon::study {

/// How a view shows the neighbourhood of a surface point.
class ViewMap {
 public:
  /// All must outlive it.
  /// @param view  of that kind, as it is drawn
  ViewMap(const surface::LimitSurface& surface, const ViewKind& kind,
          const render::RenderView& view)
      : surface_(surface), kind_(kind), view_(view), clip_(view.clipFromWorld) {}

  /// A face's side in samples where neighbouring tiles are no neighbours on the surface: in the
  /// atlas of a surface whose faces form no grid. 0 otherwise.
  [[nodiscard]] int tileSide() const;

  /// Columns and rows (downward) a world unit along a tangent: in a camera view by the Jacobian of
  /// the projection at P, in an atlas by solving for the tangent as a P_s + b P_t, since there
  /// columns run along s and rows against t. Not finite where the view shows no such thing.
  [[nodiscard]] Vec2 image(const surface::TangentPoint& point, const Vec3& tangent) const;

 private:
  [[nodiscard]] Vec2 imageInCamera(const Vec3& position, const Vec3& tangent) const;

  const surface::LimitSurface& surface_;
  const ViewKind& kind_;
  const render::RenderView& view_;
  glm::dmat4 clip_;
};

/// Upper bound on the distance between neighbouring samples of a connected surface, world units: 3
/// times the world lengths of a column and of a row together, since rounding to the nearest sample
/// at both ends moves a step by less than 2 of either. Not finite where the surface is seen
/// edge-on.
/// @param normal  outwardNormal of the point
double sampleSpacing(const ViewMap& map, const surface::TangentPoint& point, const Vec3& normal);

/// How a view's samples lie beside each other, for boundary metrics.
///
/// In a camera the unit is the pixel, and the surface breaks between two neighbours that lie
/// farther apart in the world than the `sampleSpacing` of one of them: at the contour of a fold, or
/// of a bump of a displaced mesh.
///
/// In an atlas the unit is the texel: a step to the next column is |∂(x, y)/∂s| over a face's
/// samples a side, one to the next row |∂(x, y)/∂t|, each the mean of what it is at the middles of
/// all faces. All built-in shapes have the same everywhere, so that distances are those on the
/// texture's plane. Nothing breaks within a face, nor between those of a grid chart; the tiles of
/// other surfaces stand alone. The picture's edge is one too where a closed surface goes on.
/// @param texelsPerUv  repeats × map size
compare::SampleLayout makeSampleLayout(const surface::LimitSurface& surface, Vec2 texelsPerUv,
                                       const ViewKind& kind, const render::RenderView& view,
                                       const surface::SampleGrid& samples);

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
