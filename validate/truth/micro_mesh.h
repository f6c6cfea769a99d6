#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "common/progress.h"
#include "common/raw_vector.h"
#include "common/vec.h"
#include "relief/relief.h"
#include "surface/face_grids.h"
#include "surface/limit_surface.h"

namespace gnomon::truth {

/// How finely the displaced surface is cut.
struct MicroMeshSettings {
  /// Longest micro-edge along a texture axis, texels. Where unset, the largest 1/4, 1/8, 1/12 … of
  /// a texel that gives at least `leastTriangles`.
  std::optional<double> stepTexels;
  double leastTriangles = 4e6;
};

/// The grid lines of a micro-mesh on every face of a surface.
///
/// On a cage that is a regular grid with affine texture coordinates the lines of texel centres are
/// among them: the kinks of the bilinear relief then lie on micro-edges. Elsewhere lines are evenly
/// spaced, so many that no micro-edge along s or t is longer than the step: each edge ring (see
/// closed_surface.h) has the pieces that its longest edge needs, so that a large face gets more
/// than a small one and neighbours still share vertices. No ring has less than a quarter of the
/// pieces of an average face, so that the mesh follows the surface's curvature even where few
/// texels lie on it.
struct MicroLines {
  double askedTexels = 0;                  ///< the step that lines were placed by
  double longestTexels = 0;                ///< the longest micro-edge along s or t, on the map
  std::vector<std::vector<double>> lines;  ///< rising parameters from 0 to 1
  std::vector<surface::FaceLines> faces;   ///< which of them cross each face
};

/// @param texelsPerUv  as in texelFrame
/// @param bytesPerQuad  memory that a micro-quadrilateral will take
/// @throws MemoryError naming `step` where the mesh cannot fit; InputError for a step that is not
///   positive, that needs more lines across a face than Embree's grids can have, or that cannot
///   be found
MicroLines placeMicroLines(const surface::LimitSurface& surface, Vec2 texelsPerUv,
                           const MicroMeshSettings& settings, double bytesPerQuad);

/// How far over its facet a shadow ray starts, as a share of the mesh's largest coordinate.
constexpr double standardRayOffset = 1e-6;

/// How far the parameters of a sample may be off, of a face's side: they are floats that GL
/// interpolates, and each processor rounds them in its own way. Grid lines run through texel
/// centres, and many samples of an atlas lie on them too, where several facets meet; which of these
/// is a sample's own must not depend on that rounding.
constexpr double parameterRounding = 1e-6;

/// A flat piece of the displaced surface.
struct Facet {
  Vec3 point;   ///< the asked point on it, in the mesh's own (centred) coordinates
  Vec3 normal;  ///< unit, outward; zero where the facet has no area

  /// Whether the facet is turned from a light, so that the point is in attached shadow and needs no
  /// ray.
  /// @param light  unit vector toward the light
  [[nodiscard]] bool facesAwayFrom(const Vec3& light) const { return glm::dot(normal, light) <= 0; }
  /// Where a shadow ray from the point starts: off the facet along its normal, so that rounding
  /// does not let the ray meet the facet itself.
  /// @param offset  world length, see MicroMesh::rayOffset
  [[nodiscard]] Vec3 rayOrigin(double offset) const { return point + offset * normal; }
};

/// The displaced limit surface as one grid of vertices a face. Vertices that faces share (corners,
/// and edges of equal cage vertices) are computed once, by the first of the faces, so that
/// neighbours agree to the bit and a closed cage gives a closed mesh. Across a texture seam, where
/// the heights of the two sides differ, the first face's height rules the common edge, and the
/// second face rises or falls to it within its outermost micro-step: a wall between the two
/// heights, upright in the limit. A wall, because neither side's relief is bent by it beyond that
/// step, as it would be by a blend; and on the mesh's own vertices, because walls of their own
/// would need slivers where they meet. The same holds at a crease, where the two sides' normals
/// differ.
///
/// Where the grid lines run: see MicroLines.
class MicroMesh {
 public:
  /// @param progress  may throw to cancel, see common/progress.h
  /// @throws MemoryError naming `step` where mesh and hierarchy cannot fit; InputError as
  ///   placeMicroLines, and for 2^32 vertices and more
  MicroMesh(const surface::LimitSurface& surface, const relief::Relief& relief,
            const MicroMeshSettings& settings, const Progress& progress = {});

  [[nodiscard]] const surface::FaceGrids& grids() const { return grids_; }
  /// x, y, z of each vertex relative to `centre()`, and one float of padding at the end.
  [[nodiscard]] std::span<const float> coordinates() const { return coordinates_; }
  [[nodiscard]] std::size_t vertexCount() const { return grids_.vertexCount(); }
  [[nodiscard]] std::size_t triangleCount() const { return grids_.triangleCount(); }
  [[nodiscard]] const Vec3& centre() const { return centre_; }
  /// Largest absolute coordinate, world units: the scale of float rounding.
  [[nodiscard]] double extent() const { return extent_; }
  /// How far over their facets rays start, world length: a share of the extent.
  [[nodiscard]] double rayOffset(double share = standardRayOffset) const { return share * extent_; }
  /// Longest micro-edge along s or t of any face, texels on the map.
  [[nodiscard]] double stepTexels() const { return longestTexels_; }
  /// The step that lines were placed by: a micro-edge may be shorter, none is longer.
  [[nodiscard]] double askedStepTexels() const { return askedTexels_; }

  /// The facet above (s, t) of a face, and the point on it: no search, no ray. Of facets that meet
  /// there, within parameterRounding, it is the one that a step from the place leads onto.
  /// It is always one of this face, at a border too.
  /// @param toward  the step's direction in (s, t), of any length. Along an axis where it has no
  ///   part, less than 1e-5 of it, the step goes toward larger s or t, and so it does where it is
  ///   zero.
  [[nodiscard]] Facet facet(int face, double s, double t, const Vec2& toward = {0, 0}) const;
  [[nodiscard]] Facet facet(const surface::SurfaceSample& sample) const {
    return facet(sample.face, sample.s, sample.t);
  }
  /// The parameters of a place on a face's grid, as SurfaceHit has it.
  [[nodiscard]] surface::SurfaceSample parametersAt(int face, const Vec2& place) const;

 private:
  MicroMesh(MicroLines lines, const surface::LimitSurface& surface, const relief::Relief& relief,
            const Progress& progress);
  void reserve();
  void displace(const surface::LimitSurface& surface, const relief::Relief& relief,
                const Progress& progress);
  void weld(const surface::LimitSurface& surface);
  void measureExtent();
  [[nodiscard]] Vec3 vertex(std::size_t index) const;

  double askedTexels_;
  double longestTexels_;
  surface::FaceGrids grids_;
  RawVector<float> coordinates_;
  Vec3 centre_{0, 0, 0};
  double extent_ = 0;
};

}  // namespace gnomon::truth
