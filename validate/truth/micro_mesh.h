#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/progress.h"
#include "common/raw_vector.h"
#include "relief/relief.h"
#include "surface/limit_surface.h"
#include "truth/micro_lines.h"

namespace gnomon {

/// A flat piece of the displaced surface.
struct Facet {
  Vec3 point;   ///< the asked point on it, in the mesh's own (centred) coordinates
  Vec3 normal;  ///< unit, outward; zero where the facet has no area
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
  /// @throws MemoryError naming `truth.step` where mesh and hierarchy cannot fit; InputError as
  ///   placeMicroLines, and for 2^32 vertices and more
  MicroMesh(const LimitSurface& surface, const Relief& relief, const MicroMeshSettings& settings,
            const Progress& progress = {});

  /// Grid of one face: vertex (i, j) is `firstVertex + j * columns + i`.
  struct Grid {
    std::uint32_t firstVertex;
    int sLines;   ///< index into lines(): parameters s of the columns
    int tLines;   ///< index into lines(): parameters t of the rows
    int columns;  ///< vertices along s
    int rows;     ///< vertices along t
  };

  [[nodiscard]] const std::vector<Grid>& grids() const { return grids_; }
  /// Rising parameters from 0 to 1.
  [[nodiscard]] const std::vector<double>& lines(int index) const {
    return lines_.lines[static_cast<std::size_t>(index)];
  }
  /// x, y, z of each vertex relative to `centre()`, and one float of padding at the end.
  [[nodiscard]] std::span<const float> coordinates() const { return coordinates_; }
  [[nodiscard]] std::size_t vertexCount() const { return vertexCount_; }
  [[nodiscard]] std::uint64_t triangleCount() const { return triangleCount_; }
  [[nodiscard]] const Vec3& centre() const { return centre_; }
  /// Largest absolute coordinate, world units: the scale of float rounding.
  [[nodiscard]] double extent() const { return extent_; }
  /// Longest micro-edge along s or t of any face, texels on the map.
  [[nodiscard]] double stepTexels() const { return lines_.longestTexels; }
  /// The step that lines were placed by: a micro-edge may be shorter, none is longer.
  [[nodiscard]] double askedStepTexels() const { return lines_.askedTexels; }

  /// The facet above (s, t) of a face, and the point on it: no search, no ray.
  [[nodiscard]] Facet facet(int face, double s, double t) const;

 private:
  void makeGrids();
  void displace(const LimitSurface& surface, const Relief& relief, const Progress& progress);
  void weld(const LimitSurface& surface);
  void measureExtent();
  [[nodiscard]] Vec3 vertex(std::size_t index) const;

  MicroLines lines_;
  std::vector<Grid> grids_;
  RawVector<float> coordinates_;
  std::size_t vertexCount_ = 0;
  Vec3 centre_{0, 0, 0};
  double extent_ = 0;
  std::uint64_t triangleCount_ = 0;
};

}  // namespace gnomon
