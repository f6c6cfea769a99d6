#pragma once

#include <optional>

#include "study/spec/sections/study_key.h"
#include "truth/micro_mesh.h"

namespace gnomon::study {

/// `[truth]`: how finely the displaced surface is cut for the truth.
struct TruthSpec : truth::MicroMeshSettings {
  /// Largest flip rate that is wanted; the step is then found by refinement.
  std::optional<double> uncertainty;
  /// N: directions of equal solid angle toward the disc of a light that has one; even.
  int directions = 256;

  /// The micro-mesh's settings alone.
  [[nodiscard]] const truth::MicroMeshSettings& ofMesh() const { return *this; }
};

/// @param resample  as Relief::resample: the file counts texels of the map before it
inline StudyKeys keysOf(TruthSpec& truth, int resample) {
  return {
      studyKey("step", OptionalNumber{&truth.stepTexels, static_cast<double>(resample)},
               "texels: longest micro-edge", positive, "what gives `triangles`"),
      studyKey(
          "uncertainty", OptionalNumber{&truth.uncertainty},
          "in place of `step`: the largest share of samples that may change from one level to the "
          "next, under a soft light the largest mean change of their shares. The step is halved "
          "from one texel on until it holds; the report has the levels. "
          "A run that cannot reach it within its memory or 10⁹ micro-triangles ends with how far "
          "it came",
          {0, 1, true}, "none"),
      studyKey("triangles", numbers(truth.leastTriangles),
               "in place of `step`: at least so many micro-triangles", {1, 1e9}),
      studyKey("directions", Unusual{&truth.directions, 256},
               "even: directions that a light's disc is traced toward, where it has a `radius`",
               {32, 65536}, {}, Enters::shares)};
}

}  // namespace gnomon::study
