#pragma once

#include <span>
#include <vector>

#include "common/light.h"
#include "common/vec.h"

namespace gnomon::truth {

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
