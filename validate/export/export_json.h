#pragma once

#include <string>
#include <vector>

#include "export/mesh_distance.h"
#include "horizon/table_file.h"
#include "study/run/scene/run_scene.h"
#include "study/run/truth_study.h"
#include "study/spec/file_names.h"

namespace gnomon::exporting {

/// What an export says of its displaced mesh.
struct ExportedMesh {
  int subdivisions = 0;
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  bool closed = false;
  MeshDistance distance = {};  ///< to the truth's surface
};

/// The export's description, schema "gnomon-export/1": files, units, conventions, camera matrices,
/// lights. Enough for another renderer to answer at the study's samples.
/// @param rayLift             world length by which the truth's rays start off their facets
/// @param drawnUncertainties  [view][light], as `drawnUncertainties` gives them
std::string exportJson(study::RunScene& scene, const study::StudyRecord& record,
                       const ExportedMesh& mesh, const horizon::StoredHorizons& tables,
                       double rayLift, const std::vector<std::vector<double>>& drawnUncertainties);

}  // namespace gnomon::exporting
