#pragma once

#include <optional>

#include "study/spec/sections/study_key.h"
#include "truth/micro_mesh.h"

namespace gnomon::study {

/// `[truth]`: how finely the displaced surface is cut for the truth.
struct TruthSpec : truth::MicroMeshSettings {
  /// N: directions of equal solid angle toward the disc of a light that has one; even.
  int directions = 256;

  /// The micro-mesh's settings alone.
  [[nodiscard]] const truth::MicroMeshSettings& ofMesh() const { return *this; }
};

/// @param resample  as Relief::resample: the file counts texels of the map before it
inline StudyKeys keysOf(TruthSpec& truth, int resample) {
  return {studyKey("step", OptionalNumber{&truth.stepTexels, static_cast<double>(resample)},
                   "texels: longest micro-edge", positive, "what gives `triangles`"),
          studyKey("triangles", numbers(truth.leastTriangles),
                   "in place of `step`: at least so many micro-triangles", {1, 1e9}),
          studyKey("directions", Unusual{&truth.directions, 256},
                   "even: directions that a light's disc is traced toward, where it has a `radius`",
                   {32, 65536}, {}, Enters::shares)};
}

}  // namespace gnomon::study
