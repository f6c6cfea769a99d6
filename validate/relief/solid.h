#pragma once

#include <functional>
#include <variant>

#include "common/vec.h"
#include "relief/height_field.h"
#include "surface/limit_surface.h"

namespace gnomon::relief {

/// Solid reliefs: functions of a point in space, 0 to 1. A surface that is carved from them has no
/// seams. Lengths in world units. See each for its formula.

/// Gradient noise (Perlin 1985, with the fade curve of 2002) of several octaves:
///   ½ + ½ Σ g_i noise(2^i p / period + i-th shift) / Σ g_i, g_i = gain^i, clamped to 0 … 1.
/// Most values lie between 0.2 and 0.8. Lattice gradients are the twelve edges of a cube, by a hash
/// of the point and the seed.
struct SolidNoise {
  double period = 1;  ///< of the lowest octave
  int octaves = 3;    ///< 1 to 16
  double gain = 0.5;  ///< 0 to 1: of an octave on the one before it
  int seed = 1;       ///< 0 or more
};

/// Scales or pebbles: CellsPattern in space, of the cells of one jittered point a cube.
struct SolidCells {
  double period = 1;
  double jitter = 0.5;  ///< 0 to 1: share of its cube in which a point may lie
  double groove = 0.2;  ///< width of a rim
  int seed = 1;         ///< 0 or more
};

/// Ridges across a direction: RipplesPattern in space, t the fractional part of
///   (p · direction + meander · w(p)) / period
/// with w = 2 SolidNoise - 1 of one octave, four periods long.
struct SolidRipples {
  double period = 1;
  double windward = 0.7;  ///< 0.01 to 0.99: share of the wavelength that rises
  double meander = 0.4;   ///< that crest planes stray at most
  Vec3 direction{1, 0, 0};
  int seed = 1;  ///< 0 or more: of the meanders
};

using SolidPattern = std::variant<SolidNoise, SolidCells, SolidRipples>;
using SolidFunction = std::function<double(const Vec3& point)>;

/// The function of a solid.
/// @throws InputError naming the key: a length that is not above 0 or over 1e9, a share out of
///   range, a direction of length 0
SolidFunction solidFunction(const SolidPattern& solid);

/// Samples a solid into the map of a surface, so that both sides of every seam agree.
///
/// A texel whose centre c lies on a face of the map (texture coordinates are bilinear on a face)
/// gets amplitude · f(P), P the limit surface's point there. A texel outside all faces, but within
/// `solidMargin` texels of one, gets amplitude · f(P₀ + (c_x - x₀) P_x + (c_y - y₀) P_y): its
/// nearest point (x₀, y₀) of the map that is on a face, of position P₀, and the tangent plane
/// there. Bilinear interpolation at the very border of a chart then has right neighbours on both
/// sides of the border: it reads texels less than √2 away. Two sides of a seam that meet at P both
/// have f(P), up to what bilinear interpolation errs by: less than the largest slope of f times a
/// texel's size in the world, and of second order where f and the texture coordinates are smooth.
/// All farther texels are 0.
///
/// Of several faces that a texel may belong to, the nearest has it, and of equally near ones the
/// first: charts that are nearer to each other than two texels do take each other's texels, and
/// there the two sides do jump. Where the map repeats, texture coordinates count modulo the map;
/// otherwise faces outside [0, 1] have no texels.
/// Charts that lie on one another tear the relief: a texel has one height. Where a texel's centre
/// lies inside two faces that ask for heights more than `solidStep` apart it is disputed.
/// @throws MemoryError naming `relief.size`; InputError for a map without texels, and where more
///   than `mostDisputed` of the texels whose centres faces hold are disputed
HeightField makeSolidMap(const surface::LimitSurface& surface, int width, int height,
                         const SolidFunction& solid, double amplitude, Wrap wrap);

/// A function of a point of a surface and of the outward unit normal there.
using SurfaceFunction = std::function<double(const Vec3& point, const Vec3& normal)>;

/// The same for f(P, n). In the margin n turns with the curvature at the nearest point: by the
/// shape operator S, n ∝ n₀ + S ((c_x - x₀) P_x + (c_y - y₀) P_y). So both arguments are right to
/// first order, and what two sides differ by is of second order, as above.
HeightField makeSolidMap(const surface::LimitSurface& surface, int width, int height,
                         const SurfaceFunction& solid, double amplitude, Wrap wrap);

constexpr double solidMargin = 4;  ///< texels

/// Two values of a solid are the same height within a step of a height map of 16 bits.
constexpr double solidStep = 1.0 / 65535;

/// The share of a surface's texels that may be disputed: artists' charts fold over themselves at
/// single faces (Spot's at 0.0017 of its texels).
constexpr double mostDisputed = 0.005;

/// An image projected along the three axes of space onto a surface, and blended by its normal n:
///
///   f(p, n) = Σ_i w_i g(p_{i+1}, p_{i+2}),  w_i = |n_i|^k / Σ_j |n_j|^k,  k = 4, i modulo 3,
///
/// g the image over a plane: `period` world units wide, its texels square, its lower left corner at
/// the origin. It continues in mirror images of itself, so that any image is continuous there.
///
/// k = 4, since f is to have no features of its own: the weights are smooth where a component of n
/// changes its sign (k = 1 has a crease there, |n_i|), one image has nine tenths and more of the
/// weight up to 30° from its axis, tan⁴ 30° = 1/9, and midway between two axes the weights change
/// by k/2 = 2 a radian, less than the image does unless the surface bends on the scale of its
/// features.
///
/// @param image   of heights of the value 1; how it wraps does not matter
/// @param period  world units, above 0
/// @throws InputError naming the key for a period that is not above 0 or over 1e9
SurfaceFunction triplanar(HeightField image, double period);

}  // namespace gnomon::relief
