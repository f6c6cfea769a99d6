#pragma once

#include <array>
#include <vector>

#include "common/vec.h"
#include "surface/cage.h"

namespace gnomon {

/// Built-in shapes. Each is a cage whose limit surface *is* the shape, exactly or to the stated
/// error, in `columns` × `rows` faces; uv runs over [0, 1]² on the whole of it, u along s and the
/// columns, v along t and the rows. Normals face outward (+z for the flat patch and the middle of
/// the sphere patch). Lengths are world units, angles radians.

/// The rectangle [-width/2, width/2] × [-height/2, height/2] in z = 0. Exact.
Cage makePlane(double width, double height, int columns, int rows);

/// Part of a cylinder of radius R about the y axis: (R sin λ, y, R cos λ), λ from -span/2 to
/// span/2, y from -height/2 to height/2; closed where span = 2π. The outward normal at λ = 0 is +z.
/// Error: see sphere.
Cage makeCylinder(double radius, double longitudeSpan, double height, int columns, int rows);

/// Part of a sphere: R (sin λ cos φ, sin φ, cos λ cos φ), longitude λ and latitude φ each centred
/// on 0. Control points are the sphere's own points times one constant an axis, c = 3 / (2 + cos Δ)
/// for the angle Δ of one face, which makes the cubic B-spline interpolate at the knots. Position
/// errs by about Δ⁴/384 · R, curvature by Δ²/12 relative. (…and the shape is refused with
/// InputError where a face spans so much that position would err by 1e-5 R or curvature by 0.1 %.)
Cage makeSphere(double radius, double longitudeSpan, double latitudeSpan, int columns, int rows);

/// A torus about the y axis: the circle of radius `minor` about a circle of radius `major`.
/// Closed in both directions. Error: as the sphere, for the larger angle.
Cage makeTorus(double major, double minor, int columns, int rows);

/// A bicubic Bézier patch of 4 × 4 control points (row by row, v slowest), cut into
/// `columns` × `rows` faces. Exact: knots are inserted by blossoming and the outermost control
/// points are found by extending the polynomial, so that every face carries a piece of it.
Cage makeBezier(const std::array<Vec3, 16>& points, int columns, int rows);

/// A uniform bicubic B-spline surface of `pointColumns` × `pointRows` control points (row by row):
/// (pointColumns - 3) × (pointRows - 3) faces. Exact.
Cage makeBSpline(const std::vector<Vec3>& points, int pointColumns, int pointRows);

}  // namespace gnomon
