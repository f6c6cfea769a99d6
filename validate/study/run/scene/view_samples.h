#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "common/raw_vector.h"
#include "common/vec.h"
#include "compare/answer_metrics.h"
#include "compare/shadow_length.h"
#include "relief/relief.h"
#include "render/gpu_scene.h"
#include "study/spec/sections/view_section.h"
#include "surface/curvature.h"
#include "surface/limit_surface.h"
#include "surface/sample_grid.h"
#include "surface/texel_frame.h"

namespace gnomon::study {

/// Quantities by which a view's samples are sorted into bins, so that a study says not only how
/// often a method errs but where.

/// What an axis may look at: one sample of the exact limit surface under one light, whose direction
/// in the tangent plane is T.
struct AxisSample {
  double elevation;     ///< asin(n·L): of the light over the tangent plane, radians
  double curvature;     ///< κ(T), 1 / world length, convex positive; 0 for a light along n
  double normalChange;  ///< |S T|: how much n turns along T, radians a world length, 0 or more
  double height;        ///< a h: of the relief above the sample, world length
  double texel;         ///< |P_x × P_y|^½: world length of a texel
  double headroom = 0;  ///< from `height` up to the relief's highest, world length
  double stretch = 1;   ///< uvStretch of its frame
};

/// What an axis needs of a sample, whatever the light.
struct AxisPlace {
  surface::ShapeOperator shape;
  Vec3 normal;      ///< unit, outward
  double height;    ///< as AxisSample's
  double texel;     ///< likewise
  double headroom;  ///< likewise
  double stretch;   ///< likewise
  bool defined;     ///< whether its frame is; else nothing of it means anything
};

/// @param frame  of the same point
AxisPlace axisPlace(const surface::LimitPoint& point, const surface::TexelFrame& frame,
                    const relief::Relief& relief);

/// The sample at a place that is defined. @param light  unit vector toward the light
AxisSample axisSample(const AxisPlace& place, const Vec3& light);

/// @param frame  of the same point, defined
/// @param light  unit vector toward the light
AxisSample axisSample(const surface::LimitPoint& point, const surface::TexelFrame& frame,
                      const relief::Relief& relief, const Vec3& light);

/// One axis. A further one is a function and a line in view_samples.cpp.
struct SampleAxis {
  std::string_view name;      ///< as files spell it
  std::string_view title;     ///< for readers
  std::string_view unit;      ///< of its values; empty for none
  std::vector<double> edges;  ///< of the bins, rising; as binOf takes them
  double (*value)(const AxisSample&);
};

/// All axes:
///   curvature_height  curvatureHeight   how far the surface bends within a bump's height; methods
///                                       for flat surfaces neglect it
///   elevation         lightElevation    degrees
///   terminator        terminatorDistance  texels
///   uv_stretch        uvStretch         what of an error is the parametrisation's
///   shadow_reach      shadowReach       texels; how far a method has to look
const std::vector<SampleAxis>& sampleAxes();

/// κ(T) · a h: the surface's normal curvature along the light, times the relief's height at the
/// sample. No unit; convex positive, 0 where the relief or the surface is flat.
double curvatureHeight(const AxisSample& sample);

/// The light's elevation over the sample's own tangent plane of the undisplaced surface, degrees,
/// -90 to 90; below 0 beyond the terminator.
double lightElevation(const AxisSample& sample);

/// How far from the sample the undisplaced surface turns from the light, texels; below 0 where it
/// has done so already. Along the surface the elevation changes by at most |S T| a world length, so
/// that to first order the terminator is elevation / |S T| away (the distance to a curve f = 0 of
/// Taubin 1991), here over the world length of a texel. Exact on a sphere, and on a cylinder that
/// is lit across its axis; ±∞ where the surface is flat along T, as in a plane, and where the light
/// stands along n.
double terminatorDistance(const AxisSample& sample);

/// How much longer a texel is in the world along its longest direction than along its shortest: the
/// ratio of the singular values of [P_x P_y], 1 or more. With the larger eigenvalue λ of their
/// metric it is λ / |P_x × P_y|. 1 where texels are squares, whatever their size.
double uvStretch(const surface::TexelFrame& frame);

/// How far over the map, in texels, the ray toward the light runs until it is above the relief's
/// highest point: headroom / tan(elevation) / texel, on a flat surface the length of the longest
/// shadow that can fall on the sample. 0 at the highest point; NaN where the undisplaced surface is
/// turned from the light.
double shadowReach(const AxisSample& sample);

/// The bins of all samples of a view, one list an axis, in the order of sampleAxes.
using SampleBins = std::vector<std::vector<std::uint8_t>>;

/// Values are rounded to a millionth first, so that one that is an edge in all but rounding, such
/// as the elevation of a light over a plane, falls into one bin everywhere. `noBin` where there is
/// no sample or no frame.
/// @param light  unit vector toward the light
SampleBins binSamples(const surface::LimitSurface& surface, const relief::Relief& relief,
                      const surface::SampleGrid& samples, const Vec3& light);

/// The places of a view's samples; undefined where there is none on the surface.
using AxisPlaces = RawVector<AxisPlace>;
AxisPlaces axisPlaces(const surface::LimitSurface& surface, const relief::Relief& relief,
                      const surface::SampleGrid& samples);

/// The same bins from these.
SampleBins binSamples(const surface::SampleGrid& samples, const AxisPlaces& places,
                      const Vec3& light);

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
