#pragma once

#include <compare>

#include "common/vec.h"
#include "horizon/horizon_bake.h"
#include "horizon/stored_table.h"
#include "study/spec/sections/study_key.h"
#include "surface/base_mesh.h"
#include "truth/micro_mesh.h"

namespace gnomon::study {

/// `[bake]`: the tables that methods read.
struct BakeSpec {
  horizon::BakeSettings settings;
  horizon::TableBits bits = horizon::TableBits::eight;
  double angleLimit = pi / 2;  ///< of horizon angles: the largest off the normal, radians
};

/// @param resample  as Relief::resample: the file counts texels of the map before it
inline StudyKeys keysOf(BakeSpec& bake, int resample) {
  using enum Enters;
  const std::vector<std::pair<horizon::TableBits, std::string>> bits = {
      {horizon::TableBits::eight, "8"},
      {horizon::TableBits::sixteen, "16"},
      {horizon::TableBits::thirtyTwo, "32"}};
  return {studyKey("azimuths", &bake.settings.azimuths, "directions of a table", {1, 1024}, {},
                   horizons | shotAngles),
          studyKey("radius", numbers(bake.settings.radiusTexels, resample),
                   "texels: how far tables are searched and maps are marched", {0, 1e5, true},
                   "by the rule of the search radius", horizons | search),
          studyKey("bits", chosenName(bake.bits, bits, true), "of a table's entry", {}, {}, codes),
          studyKey("limit", degrees(bake.angleLimit),
                   "degrees: largest horizon angle off the normal, of methods that store angles",
                   {1, 180}, {}, flatAngles | shotAngles)};
}

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
          "without a limit surface must; the only one with `scheme = \"none\"`",
          {}, "`'limit'`, with `scheme = \"none\"` `'vertices'`")};
}

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
