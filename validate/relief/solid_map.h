#pragma once

#include <functional>

#include "relief/height_field.h"
#include "relief/solid.h"
#include "surface/limit_surface.h"

namespace gnomon::relief {

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

}  // namespace gnomon::relief
