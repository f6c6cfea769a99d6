#pragma once

#include <array>
#include <vector>

#include "common/vec.h"
#include "surface/cage/cage.h"

namespace gnomon::surface {

/// Built-in shapes. Each is a cage whose limit surface *is* the shape, exactly or to the stated
/// error, in `columns` × `rows` faces; uv runs over [0, 1]² on the whole of it, u along s and the
/// columns, v along t and the rows. Normals face outward (+z for the flat patch and the middle of
/// the sphere patch). Lengths are world units, angles radians.
///
/// Every maker raises InputError naming the parameter: lengths must be above 0 (a sphere's radius
/// may be below) and at most 1e12, columns and rows 1 to 4096, longitude spans at most 2π, latitude
/// spans below π. Shapes with arcs refuse faces so large that a curvature would err by 0.1 % of the
/// larger of the two at that point; the message says how many are needed (58 for a full turn; more
/// rows and columns where a sphere comes near its poles, since there a tilt of the normal counts
/// for more).

/// The rectangle [-width/2, width/2] × [-height/2, height/2] in z = 0. Exact.
Cage makePlane(double width, double height, int columns, int rows);

/// Part of a cylinder of radius R about the y axis: (R sin λ, y, R cos λ), λ from -span/2 to
/// span/2, y from -height/2 to height/2; closed where span = 2π. The outward normal at λ = 0 is +z.
/// Error: see sphere.
Cage makeCylinder(double radius, double longitudeSpan, double height, int columns, int rows);

/// Part of a sphere: R (sin λ cos φ, sin φ, cos λ cos φ), longitude λ and latitude φ each centred
/// on 0. Control points are the sphere's own points times one constant an axis, c = 3 / (2 + cos Δ)
/// for the angle Δ of one face, which makes the cubic B-spline interpolate at the knots. Position
/// errs by about Δ⁴/384 · R an axis (less than 1e-6 R, since Δ must be below 0.11), curvature by
/// Δ²/12 relative. Closed in longitude where longitudeSpan = 2π. A negative radius makes the inside
/// of the sphere: the patch mirrored in z = 0, a bowl whose middle faces +z, with the same uv.
Cage makeSphere(double radius, double longitudeSpan, double latitudeSpan, int columns, int rows);

/// A torus about the y axis: a tube of radius `minor` < `major` about a circle of radius `major`,
/// ((major + minor cos ψ) sin λ, minor sin ψ, (major + minor cos ψ) cos λ), closed in both
/// directions. λ and ψ run from -π to π: uv = (½, ½) is (0, 0, major + minor). Error: as the
/// sphere, for the larger angle, position relative to major + minor.
Cage makeTorus(double major, double minor, int columns, int rows);

/// A bicubic Bézier patch of 4 × 4 control points (row by row, v slowest), cut into
/// `columns` × `rows` faces. Exact: control points are blossoms at the knots (Ramshaw 1987), and
/// the outermost control points are found by extending the polynomial, so that every face carries a
/// piece of it.
Cage makeBezier(const std::array<Vec3, 16>& points, int columns, int rows);

/// A uniform bicubic B-spline surface of `pointColumns` × `pointRows` control points (row by row):
/// (pointColumns - 3) × (pointRows - 3) faces. Exact.
Cage makeBSpline(const std::vector<Vec3>& points, int pointColumns, int pointRows);

}  // namespace gnomon::surface
