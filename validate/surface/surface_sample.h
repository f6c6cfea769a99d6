#pragma once

#include <cstddef>

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

}  // namespace gnomon::surface
