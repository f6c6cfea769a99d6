#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "surface/limit_surface.h"

namespace gnomon::surface {

/// One face of a limit surface, prepared for evaluation at many points.
///
/// A face that is one bicubic polynomial, P(s, t) = Σ c_ij s^i t^j, is evaluated as that. Its
/// position, first derivatives and mixed second derivative at the four corners determine it (the
/// bicubic Hermite patch; Ferguson 1964). It agrees with LimitSurface::tangentPoint to rounding,
/// which evaluates all other faces.
class LimitFace {
 public:
  /// @param surface  outlives this
  /// @param points   expected number of evaluations: the polynomial pays off above ten
  LimitFace(const LimitSurface& surface, int face, std::size_t points);

  /// The point at (s, t).
  [[nodiscard]] TangentPoint at(double s, double t) const;

  /// The same with second derivatives: agrees with LimitSurface::evaluate to rounding.
  [[nodiscard]] LimitPoint evaluate(double s, double t) const;

  /// Points of one row of parameters: points[k] is at (s[k], t).
  /// @param points  as many as there are parameters
  void row(double t, std::span<const double> s, std::span<TangentPoint> points) const;

 private:
  using Cubic = std::array<Vec3, 4>;  ///< coefficients of 1, x, x², x³

  const LimitSurface* surface_;
  int face_;
  bool bicubic_;
  std::array<Cubic, 4> rows_{};  ///< [j][i]: coefficient of s^i t^j
  std::array<Vec2, 4> uvs_{};    ///< at the corners (0,0), (1,0), (1,1), (0,1)
};

/// All faces of a surface, in order.
/// @param surface  outlives them
/// @param points   expected number of evaluations, of all faces together
std::vector<LimitFace> limitFaces(const LimitSurface& surface, std::size_t points);

}  // namespace gnomon::surface
