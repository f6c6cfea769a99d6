#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "surface/limit_surface.h"

namespace gnomon {

/// The grid of vertices over one face: vertex (i, j) is `firstVertex + j * columns + i`, s rising
/// with i from 0 to 1 and t with j.
struct FaceGrid {
  std::uint32_t firstVertex;
  int columns;  ///< vertices along s, at least 2
  int rows;     ///< vertices along t, at least 2
};

/// Visits every vertex on a face's border that an earlier face has too (on an edge between the same
/// two cage vertices, or at the same cage vertex), as `visit(first, vertex)`: `first` is the vertex
/// of the first face that has it, and is never visited as `vertex` itself. Copying the former to
/// the latter makes neighbours agree to the bit. Faces that share an edge must have the same number
/// of vertices along it.
/// @param gridOf  the grid of a face
void forEachSharedVertex(const LimitSurface& surface,
                         const std::function<FaceGrid(std::size_t face)>& gridOf,
                         const std::function<void(std::size_t first, std::size_t vertex)>& visit);

}  // namespace gnomon
