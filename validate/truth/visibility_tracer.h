#pragma once

#include <span>
#include <vector>

#include "common/light.h"
#include "common/mask.h"
#include "common/progress.h"
#include "common/vec.h"
#include "surface/sample_grid.h"
#include "truth/displaced_picture.h"
#include "truth/micro_mesh.h"
#include "truth/micro_scene.h"
#include "truth/shadow_tracer.h"

namespace gnomon::truth {

/// How many directions on the disc's edge come before those that count.
constexpr int rimDirections = 16;

/// A light's disc and how it is traced.
struct DiscSettings {
  Light light = {};      ///< soft
  int directions = 256;  ///< N
  /// As in TraceSettings.
  double rayOffset = standardRayOffset;
  bool isAdaptive = true;  ///< else every sample gets all N
};

/// The share of a light's disc that each sample sees: V = n / N, n the number of the N directions
/// of `discDirections` that its displaced point sees. It sees a direction that its facet is not
/// turned from and along which a ray, which starts as the hard light's does (Facet::rayOrigin),
/// meets nothing. The directions are the same for all samples.
///
/// Every sample is first traced toward half of `rimDirections` on the disc's edge, which do not
/// count: the samples take the one half or the other as a chess board its colours. Where they agree
/// with each other and with the hard light, which is the disc's centre, at a sample and at its
/// eight neighbours in the view, the sample's V is 0 or 1 as they say. A sample that only disagrees
/// with a neighbour is traced toward the other half of the rim and every second of the N; where
/// these agree too, its V is 0 or 1. All others get the N. What is missed lies between these
/// directions: of a straight edge no more than 0.0016 of the disc (discRim) where the neighbours
/// see it in the same place, else slits and spikes. Over rough reliefs |ΔV| is less than 1e-5 in
/// the mean (tests).
///
/// Results do not depend on the number of threads. A part of a view gives the view's own, but at
/// its border, where it begins at an even row and column.
/// @param hard      the hard light's answers at the same samples; V is `noSample` where it has none
/// @param progress  may throw to cancel, see common/progress.h
/// @throws InternalError unless `hard` has one answer a sample
Visibility traceVisibility(const MicroMesh& mesh, const MicroScene& scene,
                           const surface::SampleGrid& samples, const Mask& hard,
                           const DiscSettings& settings, const Progress& progress = {});

/// The same of the points where a camera's own rays meet the surface; a ray to the disc starts
/// `seen.rayOffset` off its facet, whatever the settings say.
Visibility traceVisibility(const SeenSurface& seen, const MicroScene& scene, const Mask& hard,
                           const DiscSettings& settings, const Progress& progress = {});

/// |ΔV| of two maps of one view, over the samples that both hold, each counted alike: the truth's
/// own error, where one was traced with half the directions on half the resolution of the other.
struct ShareChange {
  double mean = 0;
  double percentile99 = 0;   ///< the smallest |ΔV| that 99 % of the samples do not exceed
  double percentile999 = 0;  ///< the same of 99.9 %
};
/// Zeros where there is no sample.
/// @throws InternalError for maps of different sizes
ShareChange shareChange(const Visibility& a, const Visibility& b);

/// A truth's own error, where the other one was traced at half its resolution: `flipRate` of the
/// masks; of a light with a disc the mean of |ΔV|, where half as many directions were traced too.
/// @throws InternalError as both
double uncertaintyOf(const Truth& truth, const Truth& coarse);

/// By how much the other truth is brighter, the mean of ΔV over the samples that both answer; of
/// masks V is 1 where lit and 0 where shadowed. Below 0 where coarse facets darken.
/// @throws InternalError for truths of different sizes
double brightening(const Truth& truth, const Truth& coarse);

/// Points of the unit disc, each for an equal area of it: Vogel's spiral (Vogel 1979),
///
///   r = √((k + ½) / N),  φ = k π (3 - √5),  k = 0 … N - 1,
///
/// after which each of x and y in turn is moved to the middle of its N-th of the disc's area: the
/// point of rank k along x to where (k + ½) / N of the area is on its left. So a straight edge
/// along either axis halves no more than one point's area: the share of the points beyond it is
/// right to 1/(2N). Over all edges it is right to about 1/N (root mean square; 5/N at worst for N =
/// 256): no set of N points does much better (Beck 1987), and a search for one gained a twentieth.
/// @param count  N ≥ 1
std::vector<Vec2> discPoints(int count);

/// Points evenly spaced on the unit disc's edge, x = 1 the first. A half-plane that covers more
/// than (α - sin α cos α) / π of the disc, α = π / m, covers one of m such points: 0.0016 for 16.
std::vector<Vec2> discRim(int count);

/// Directions toward a light's disc, each for an equal share of its solid angle. A point of the
/// unit disc at radius r stands for the direction at the angle a from the centre where
///
///   1 - cos a = r² (1 - cos ρ)
///
/// (Lambert's projection, which keeps areas), with x along the horizon of the xy plane and y toward
/// +z. So the directions' edges that are level in the world are those along x.
/// @param centre  unit vector toward the disc's centre
/// @param radius  ρ, radians, 0 to π
/// @param points  of discPoints
/// @returns unit vectors, in the points' order
std::vector<Vec3> discDirections(const Vec3& centre, double radius, std::span<const Vec2> points);

/// The unit vector toward the lowest point of a light's disc over the xy plane: the centre turned
/// by ρ in its vertical plane, in any one if it is on the z axis. Of a point its direction, to the
/// bit.
Vec3 lowestOfDisc(const Light& light);

}  // namespace gnomon::truth
