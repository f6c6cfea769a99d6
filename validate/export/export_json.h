#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "export/mesh_files.h"
#include "horizon/stored_table.h"
#include "study/run/run_study.h"
#include "study/run/scene/run_scene.h"
#include "study/spec/sections/study_files.h"

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

/// Where the `export.json` of a mask's export would be: one and two folders up.
std::array<std::filesystem::path, 2> exportIndices(const std::filesystem::path& truthMask);

/// The uncertainty of a truth's mask or shares that lie in an export, a share of its samples: what
/// its `export.json` states.
/// @return none for any other file
/// @throws InputError for an `export.json` that is damaged
std::optional<double> exportedUncertainty(const std::filesystem::path& truthMask);

}  // namespace gnomon::exporting
