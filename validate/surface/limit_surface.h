#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/vec.h"
#include "surface/cage/cage.h"

namespace gnomon::surface {

/// A point of the undisplaced limit surface, by its face and parameters: the place where the one
/// question is asked.
struct SurfaceSample {
  int face = -1;  ///< limit face, -1 where a pixel shows no surface
  float s = 0;    ///< 0 to 1
  float t = 0;

  /// False for a pixel that shows no surface: nothing can be evaluated there.
  [[nodiscard]] bool isOnSurface() const { return face >= 0; }
  /// The face as an index into a list of all faces.
  [[nodiscard]] std::size_t faceIndex() const { return static_cast<std::size_t>(face); }
};

/// One point of the limit surface with its first derivatives by the face's own parameters (s, t) in
/// [0, 1]²: enough for a tangent plane and a texture frame. Positions in world units.
struct TangentPoint {
  Vec3 position;
  Vec3 ds, dt;          ///< first derivatives
  Vec2 uv, uvDs, uvDt;  ///< texture coordinates and their first derivatives
  /// Of polygons, which have their own (see PolygonSurface), unit vectors: the normal of shading,
  /// and the direction in which the point is displaced. Zero on a limit surface, and where an own
  /// one is undefined: outwardNormal is both there.
  Vec3 ownNormal{0}, ownDirection{0};
};

/// The same with second derivatives, for curvature.
struct LimitPoint : TangentPoint {
  Vec3 dss, dst, dtt;
  Vec3 ownNormalDs{0}, ownNormalDt{0};  ///< first derivatives of `ownNormal`
};

/// P_s × P_t normalised: the outward normal, since faces run counter-clockwise seen from outside.
/// Zero where P_s and P_t span no area (less than 1e-12 of the square of the longer one).
Vec3 outwardNormal(const TangentPoint& point);

/// The normal that the point is shaded with: its own, or outwardNormal.
inline Vec3 shadingNormal(const TangentPoint& point) {
  return point.ownNormal == Vec3(0) ? outwardNormal(point) : point.ownNormal;
}

/// The limit surface of a cage by its scheme, evaluated at any parameter by OpenSubdiv's Bfr at
/// approximation level 10: exact to rounding, except within 2⁻¹⁰ of a face from an extraordinary
/// vertex. There a point slides along the surface by up to 1e-5 (valence 3) or 4e-4 (valence 6) of
/// a face's size and leaves it by less than 2e-7; second derivatives mean nothing. At the end of an
/// infinitely sharp crease a point errs by up to 2e-5 of a face's size.
///
/// Faces are numbered from 0 among those that have a limit surface. A triangle of a Loop cage
/// counts as three faces, one a corner, so that every face is a square in (s, t): (0, 0) is the
/// corner, (1, 0) the middle of the side that leaves it, (1, 1) the triangle's centroid and (0, 1)
/// the middle of the side that comes to it, bilinearly between them. All const members may be
/// called from several threads at once.
///
/// Of a cage of scheme `none` it is the polygons themselves, evaluated by PolygonSurface: no
/// refinement, and no limit. Any number of their faces may meet at an edge.
class LimitSurface {
 public:
  /// @throws InputError naming the face, vertex or crease: an index out of range, a coordinate that
  ///   is not finite or beyond 1e12, a face with a repeated vertex, an edge that more than two
  ///   faces share or that two traverse in the same direction, a vertex whose faces form more than
  ///   one fan or are more than 256, a crease that is no edge, no face with a limit surface, a grid
  ///   of another size
  /// @throws MemoryError if it cannot fit
  explicit LimitSurface(const Cage& cage);
  ~LimitSurface();
  LimitSurface(LimitSurface&&) noexcept;
  LimitSurface& operator=(LimitSurface&&) noexcept;
  LimitSurface(const LimitSurface&) = delete;
  LimitSurface& operator=(const LimitSurface&) = delete;

  [[nodiscard]] int faceCount() const;
  /// Whether it is polygons as they are, whose points have own normals.
  [[nodiscard]] bool isPolygons() const;
  /// How many faces a cage face counts as, one after the other: 1, or the 3 of a triangle.
  [[nodiscard]] int facesPerCageFace() const;
  /// The regular grid that the faces form, if they form one.
  [[nodiscard]] std::optional<GridChart> grid() const;
  /// The vertices at (s, t) = (0,0), (1,0), (1,1), (0,1): faces that share two of them in opposite
  /// order share that edge. Those of the cage, and on a Loop cage also middles of sides and
  /// centroids, numbered after them.
  [[nodiscard]] std::array<int, 4> corners(int face) const;
  /// The texture coordinates there.
  [[nodiscard]] std::array<Vec2, 4> cornerUvs(int face) const;
  /// Number of vertices that `corners` refers to.
  [[nodiscard]] int vertexCount() const;
  /// Position and derivatives at (s, t) of a face. 0 ≤ s, t ≤ 1.
  [[nodiscard]] LimitPoint evaluate(int face, double s, double t) const;
  [[nodiscard]] LimitPoint evaluate(const SurfaceSample& sample) const {
    return evaluate(sample.face, sample.s, sample.t);
  }
  /// The same without second derivatives, to the bit, in about half the time; on a Loop cage it is
  /// `evaluate` itself.
  [[nodiscard]] TangentPoint tangentPoint(int face, double s, double t) const;
  [[nodiscard]] TangentPoint tangentPoint(const SurfaceSample& sample) const {
    return tangentPoint(sample.face, sample.s, sample.t);
  }
  /// Whether the face is one polynomial, cubic in s and in t: a Catmull-Clark face without
  /// extraordinary vertices and creases is.
  [[nodiscard]] bool isBicubic(int face) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// "3.5.0": the version that this program was built against.
std::string openSubdivVersion();

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
