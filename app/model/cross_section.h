#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/vec.h"
#include "horizon/reference.h"
#include "image/images.h"
#include "relief/relief.h"
#include "surface/limit_surface.h"
#include "surface/sample_grid.h"

namespace gnomon::app {

/// The section of a displaced surface with the plane through one sample's normal and the light:
/// Figures 1 and 2 of Onoue, Max & Nishita 2004 as data.
///
/// Its plane has x along V, the unit tangential part of L, and y along n, both in world units, with
/// the undisplaced sample P at the origin; the shaded point is (0, h₀).

/// A light's horizon as one formula sees it. Shadowed where tan θ > horizon does not hold.
struct SectionHorizon {
  double slope = 0;       ///< tan β′ over the tangent plane; may be minus infinity
  bool shadowed = false;  ///< what it says of the light's centre
  double share = 1;       ///< V of the light's disc over it by `discShare`; of a point 0 or 1
};

/// All formulas on one pair of δ and d.
struct SectionHorizons {
  horizon::HorizonLookups lookups;  ///< κ, h₀, tan β and d, in the world
  SectionHorizon flat;              ///< tan β: what `max-forsyth` compares with
  SectionHorizon smallAngle;        ///< (2)
  SectionHorizon unreduced;         ///< the formula without a number
  SectionHorizon exact;             ///< on the osculating circle
  SectionHorizon bare;              ///< (3): minus infinity where κ ≤ 0
  bool onoue2003 = false;      ///< shadowed by (2) or (3), with κ counted as 0 where it is below
  bool onoue2004 = false;      ///< shadowed by (2) or (3)
  bool onoueExact = false;     ///< shadowed by `exact` or (3)
  double onoue2004Share = 1;   ///< V over the larger of (2) and (3)
  double onoueExactShare = 1;  ///< V over the larger of `exact` and (3)
};

/// The tables that a method reads.
struct SectionTables {
  const horizon::StoredTable& horizon;   ///< δ
  const horizon::StoredTable& distance;  ///< d
  horizon::TableShape shape;             ///< of both
};

struct CrossSection {
  double curvature;       ///< κ(V) of the limit surface at P, 1 / world, convex positive
  double worldPerTexel;   ///< σ: world length of one texel along the light's azimuth
  double worldPerHeight;  ///< a: world length of one height unit
  double lightSlope;      ///< tan θ; ±infinity for a light along the normal
  Vec2 lightDirection;    ///< the unit ray toward the light, in the plane
  double lightRadius;     ///< ρ of its disc, radians; 0 for a point
  Vec2 lowestRay;         ///< the unit ray toward the disc's lowest point, in the plane
  Vec2 highestRay;        ///< likewise

  /// Figure 1: the flat relief along the light's azimuth, height units over texels.
  horizon::HeightProfile profile;
  /// Its horizon from the sample itself, no table between.
  horizon::FlatHorizon horizon;
  /// The formulas on that horizon.
  SectionHorizons here;
  /// The formulas on what the shader reads: δ and d filtered between texels and azimuths. Absent
  /// without tables.
  std::optional<SectionHorizons> fromTables;

  /// Figure 2: the relief and the bare surface below it bent onto the osculating circle, one point
  /// for each of `profile` up to a quarter turn: (x, y), world.
  std::vector<Vec2> bentRelief, bentGround;
  Vec2 eye;           ///< the shaded point on this circle, (0, h₀)
  Vec2 horizonPoint;  ///< that of `horizon`, on the circle

  /// The plane in the world: P, V and n.
  Vec3 origin, along, up;

  /// The slope of a horizon as an angle over the tangent plane, radians, -π/2 to π/2.
  [[nodiscard]] static double angle(double slope);
  /// A world point in the plane; its distance from the plane is dropped. For the true occluder:
  /// see truth/shadow_tracer.h.
  [[nodiscard]] Vec2 inPlane(const Vec3& world) const;
};

struct SectionSettings {
  double radiusTexels = 128;  ///< D > 0: how far the profile and the search for the horizon reach
  double behindTexels = 8;    ///< ≥ 0: how much of the profile lies behind the sample
  double lightRadius = 0;     ///< ρ of the light's disc, radians
};

/// Where a height over arc length s on a circle of curvature κ lies, (x, y) as above:
///   x = (1/κ + h) sin κs,  y = (1/κ + h) cos κs - 1/κ;  (s, h) for κ → 0.
Vec2 onOsculatingCircle(double curvature, double arcLength, double height);

/// @param tables  those of a method, for `fromTables`; null for none
/// @param light   unit vector toward the light, its disc's centre
/// @return nothing where there is no sample or no frame
std::optional<CrossSection> crossSection(const surface::LimitSurface& surface,
                                         const relief::Relief& relief,
                                         const surface::SurfaceSample& sample, const Vec3& light,
                                         const SectionSettings& settings = {},
                                         const SectionTables* tables = nullptr);

/// A straight piece in the world.
struct LineSegment {
  Vec3 begin, end;
};

/// The principal directions of the base surface, drawn as short lines through points of it.
struct PrincipalLines {
  std::vector<LineSegment> larger;   ///< along v1, of the larger curvature κ₁
  std::vector<LineSegment> smaller;  ///< along v2
};

struct LineSettings {
  int perFaceSide = 2;       ///< lines through perFaceSide² points of every face, ≥ 1
  double lengthShare = 0.6;  ///< of the distance between neighbouring points
  double liftShare = 0.02;   ///< height over the surface, as a share of that distance
};

/// Lines at the middles of a regular grid of parameters. None at an umbilic, where every direction
/// is principal: κ₁ - κ₂ within 0.5 % of the larger |κ| (built-in shapes err by 0.1 %), or both so
/// small that the normal turns by less than 1e-6 over a face; and none where the surface is
/// degenerate.
/// @param settings  perFaceSide² × faces lines at most 2²⁴
/// @throws InputError if there were more
PrincipalLines principalLines(const surface::LimitSurface& surface,
                              const LineSettings& settings = {});

/// κ of the limit surface in the light's direction at every sample of a view, 1 / world, convex
/// positive; NaN-free: `defined` says where it has a meaning (a sample with a normal, and a light
/// that is not along it).
struct CurvatureField {
  std::vector<double> values;         ///< one a sample; 0 where undefined
  std::vector<std::uint8_t> defined;  ///< 1 where defined
  double largest = 0;                 ///< the largest |κ|: what the colours' ends stand for
};

/// On all threads; the same bits whatever their number.
CurvatureField curvatureAlong(const surface::LimitSurface& surface,
                              const surface::SampleGrid& samples, const Vec3& light);

/// The colours of curvature: purple where the surface bends toward the light's side (concave), near
/// white where it is flat, green where it bends away (convex). The pair stays apart for the common
/// colour vision deficiencies, is even in lightness, and is neither of the colours of errors.
struct CurvatureColours {
  static constexpr image::Rgb concave{118, 42, 131};
  static constexpr image::Rgb flat{247, 247, 247};
  static constexpr image::Rgb convex{27, 120, 55};
};

/// Linear from `flat` to the end of the value's sign, which ±largest reaches; `flat` where largest
/// is 0.
image::Rgb curvatureColour(double value, double largest);

}  // namespace gnomon::app
