#include "render/check/pass_check.h"

#include <algorithm>
#include <array>

#include "common/error.h"
#include "render/check/pass_faults.h"

namespace gnomon::render {
namespace {

/// A kind of pass with its name and its check.
struct PassEntry {
  PassKind kind;
  std::string_view name;
  std::string (*fault)(const std::filesystem::path& shaders);
};

template <TableFilter filter>
std::string filteredTableFault(const std::filesystem::path& shaders) {
  return check::tableFault(shaders, filter);
}

template <TableFilter filter>
std::string filteredBakeFault(const std::filesystem::path& shaders) {
  return check::bakeFault(shaders, filter);
}

constexpr std::array entries = {
    PassEntry{PassKind::cameraSamples, "the samples of a camera", check::cameraFault},
    PassEntry{PassKind::atlasSamples, "the samples of an atlas", check::atlasFault},
    PassEntry{PassKind::tables, "answers from tables", filteredTableFault<TableFilter::exact>},
    PassEntry{PassKind::filteredTables, "answers from tables by the GPU's filter",
              filteredTableFault<TableFilter::hardware>},
    PassEntry{PassKind::angles, "answers from horizon angles", check::angleFault},
    PassEntry{PassKind::ellipses, "answers from ellipses", check::ellipseFault},
    PassEntry{PassKind::bakes, "answers from a method's own bakes",
              filteredBakeFault<TableFilter::exact>},
    PassEntry{PassKind::filteredBakes, "answers from a method's own bakes by the GPU's filter",
              filteredBakeFault<TableFilter::hardware>},
    PassEntry{PassKind::facets, "facets of displaced geometry", check::facetFault},
    PassEntry{PassKind::texture, "a pass in the texture's plane", check::textureFault},
    PassEntry{PassKind::lightDepth, "the depth that the light sees", check::lightDepthFault},
    PassEntry{PassKind::shadowVolumes, "shadow volumes", check::volumeFault},
    PassEntry{PassKind::ownPasses, "passes of a method's own", check::ownPassFault},
    PassEntry{PassKind::ownLightPasses, "a method's own passes from the light",
              check::ownLightFault},
    PassEntry{PassKind::cameraPasses, "passes in the camera's picture", check::cameraPassFault},
    PassEntry{PassKind::shares, "shares of light", check::sharesFault},
    PassEntry{PassKind::pictures, "the pictures of masks", check::pictureFault},
};

const PassEntry& entryOf(PassKind kind) {
  const auto* found = std::find_if(entries.begin(), entries.end(),
                                   [kind](const PassEntry& entry) { return entry.kind == kind; });
  if (found == entries.end()) throw InternalError("pass: not one of its kinds");
  return *found;
}

}  // namespace

std::string_view passName(PassKind kind) {
  return entryOf(kind).name;
}

std::string passFault(PassKind kind, const std::filesystem::path& shaders) {
  return entryOf(kind).fault(shaders);
}

std::vector<PassKind> passesOf(const Method& method, TableFilter filter, bool isSoft) {
  const MethodTables& tables = method.tables;
  std::vector<PassKind> kinds;
  if (method.mesh == DrawnMesh::displaced) kinds.push_back(PassKind::facets);
  // Base meshes are shaded by the height map whatever the method reads.
  if (method.mesh == DrawnMesh::base || tables.height || tables.horizon || tables.distance) {
    kinds.push_back(filter == TableFilter::hardware ? PassKind::filteredTables : PassKind::tables);
  }
  if (tables.angles || tables.surfaceAngles) kinds.push_back(PassKind::angles);
  if (tables.ellipse) kinds.push_back(PassKind::ellipses);
  if (!method.bakes.empty()) {
    kinds.push_back(filter == TableFilter::hardware ? PassKind::filteredBakes : PassKind::bakes);
  }
  if (method.passes.texture) kinds.push_back(PassKind::texture);
  if (method.passes.lightDepth) kinds.push_back(PassKind::lightDepth);
  if (method.passes.shadowVolumes) kinds.push_back(PassKind::shadowVolumes);
  const bool fromLight = method.passes.hasOwn(PassRaster::light);
  if (fromLight) kinds.push_back(PassKind::ownLightPasses);
  if (!method.passes.own.empty()) kinds.push_back(PassKind::ownPasses);
  const bool inCamera = method.passes.cameraDepth || method.passes.hasOwn(PassRaster::camera);
  if (inCamera) kinds.push_back(PassKind::cameraPasses);
  if (isSoft && (method.answersShares || method.hasHorizon)) kinds.push_back(PassKind::shares);
  return kinds;
}

}  // namespace gnomon::render
