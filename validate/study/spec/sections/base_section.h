#pragma once

#include <compare>

#include "study/spec/sections/study_key.h"
#include "surface/base_mesh.h"

namespace gnomon::study {

/// `[base]`: the mesh that a method draws.
struct BaseSpec {
  int subdivisions = 1;
  surface::CurvatureSource curvature = surface::CurvatureSource::limit;  ///< of its vertices

  // NOLINTNEXTLINE(modernize-use-nullptr): it takes the comparison's own 0 for a pointer
  friend auto operator<=>(const BaseSpec&, const BaseSpec&) = default;
};

inline StudyKeys keysOf(BaseSpec& base) {
  const std::vector<std::pair<surface::CurvatureSource, std::string>> sources = {
      {surface::CurvatureSource::limit, "limit"}, {surface::CurvatureSource::vertices, "vertices"}};
  return {
      studyKey("subdivisions", &base.subdivisions, "pieces of every face's side", {1, 1024}),
      studyKey(
          "curvature", chosenName(base.curvature, sources),
          "of the limit surface, or estimated from the mesh's own edges and normals, as programs "
          "without a limit surface must")};
}

}  // namespace gnomon::study
