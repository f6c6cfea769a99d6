#include "study/spec/resolved_study.h"

#include <fmt/core.h>

#include <algorithm>
#include <string_view>

#include "common/degrees.h"
#include "common/error.h"
#include "common/files/atomic_file.h"
#include "common/files/input_file.h"
#include "render/method.h"
#include "study/spec/file_names.h"
#include "study/spec/method_replacement.h"
#include "study/spec/method_section.h"
#include "study/spec/study_paths.h"
#include "study/spec/study_table.h"
#include "study/spec/toml_text.h"

namespace gnomon {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view copyMark = "# The study of the results in this folder, as Gnomon ran it";

toml::array listOf(const Vec3& v) {
  return toml::array{v.x, v.y, v.z};
}

/// @param resample  as Relief::resample: a study counts texels of the map before it
toml::table bakeTable(const BakeSpec& bake, int resample) {
  return toml::table{{"azimuths", bake.settings.azimuths},
                     {"radius", bake.settings.radiusTexels / resample},
                     {"bits", static_cast<int>(bake.bits)},
                     {"limit", degreesOf(bake.angleLimit)}};
}

toml::table baseTable(int subdivisions, CurvatureSource curvature) {
  return toml::table{{"subdivisions", subdivisions},
                     {"curvature", curvature == CurvatureSource::limit ? "limit" : "vertices"}};
}

toml::table truthTable(const StudySpec& study) {
  if (study.truth.stepTexels)
    return toml::table{{"step", *study.truth.stepTexels / study.relief.resample}};
  if (study.truthUncertainty) return toml::table{{"uncertainty", *study.truthUncertainty}};
  return toml::table{{"triangles", study.truth.leastTriangles}};
}

toml::table viewTable(const ViewSpec& view) {
  if (const auto* atlas = std::get_if<AtlasSpec>(&view.kind)) {
    return toml::table{{"type", "atlas"}, {"name", view.name}, {"samples", atlas->samplesPerSide}};
  }
  const auto& camera = std::get<Camera>(view.kind);
  return toml::table{{"type", "camera"},          {"name", view.name},
                     {"eye", listOf(camera.eye)}, {"target", listOf(camera.target)},
                     {"up", listOf(camera.up)},   {"fov", degreesOf(camera.verticalFov)},
                     {"width", camera.width},     {"height", camera.height}};
}

toml::table lightTable(const LightSpec& light) {
  return toml::table{{"name", light.name},
                     {"azimuth", degreesOf(light.azimuth)},
                     {"elevation", degreesOf(light.elevation)}};
}

/// All that the shader declares, as the study sets them.
toml::table parameterTable(const MethodSpec& spec, const Method& method) {
  toml::table table;
  for (const auto& [name, parameter] : method.parameters)
    table.insert(name, parameter.defaultValue);
  for (const auto& [name, value] : spec.parameters) table.insert_or_assign(name, value);
  return table;
}

toml::table methodTable(const MethodSpec& spec, const fs::path& folder, int resample) {
  toml::table table;
  if (isBuiltIn(spec)) {
    table.insert("name", spec.file.stem().string());
  } else {
    table.insert("file", pathFrom(spec.file, folder));
  }
  table.insert("label", spec.label);
  table.insert("filter", spec.filter == TableFilter::exact ? "exact" : "hardware");
  table.insert("bake", bakeTable(spec.bake, resample));
  table.insert("base", baseTable(spec.baseSubdivisions, spec.baseCurvature));
  table.insert("parameters", parameterTable(spec, readMethod(spec.file)));
  return table;
}

template <typename Entries, typename ToTable>
toml::array tablesOf(const Entries& entries, const ToTable& toTable) {
  toml::array array;
  for (const auto& entry : entries) array.push_back(toTable(entry));
  return array;
}

/// What a run judges, as the file has it. Claims over a sweep are the sweep's.
void insertJudged(toml::table& table, const StudySpec& study, bool withSweep) {
  const auto written = [](const auto& entry) { return entry.written; };
  std::vector<ClaimSpec> claims = study.claims;
  std::erase_if(claims, [&](const ClaimSpec& claim) { return claim.gainGrows && !withSweep; });
  const auto insert = [&](const char* key, toml::array array) {
    table.erase(key);
    if (!array.empty()) table.insert(key, std::move(array));
  };
  insert("threshold", tablesOf(study.thresholds, [](const Gate& gate) {
           return std::get<Threshold>(gate.origin).written;
         }));
  insert("claim", tablesOf(claims, written));
  insert("ladder", tablesOf(study.ladders, written));
}

std::string copyStem(const std::string& study) {
  std::string stem = study;
  std::replace_if(
      stem.begin(), stem.end(), [](char c) { return !isNameCharacter(c); }, '-');
  return stem;
}

}  // namespace

std::string studyCopyName(const std::string& study) {
  return copyStem(study) + ".toml";
}

toml::table resolvedStudy(const StudySpec& study, const fs::path& folder) {
  const fs::path home = studyFolder(study.file);
  toml::table table{{"study", toml::table{{"name", copyStem(study.name)},
                                          {"title", study.title},
                                          {"source", study.source},
                                          {"ranked", study.ranked}}},
                    {"surface", study.surfaceSection},
                    {"relief", study.reliefSection},
                    {"bake", bakeTable(study.bake, study.relief.resample)},
                    {"base", baseTable(study.baseSubdivisions, study.baseCurvature)},
                    {"truth", truthTable(study)},
                    {"view", tablesOf(study.views, viewTable)},
                    {"light", tablesOf(study.lights, lightTable)}};
  insertJudged(table, study, false);
  movePaths(table, home, folder);
  table.insert("method", tablesOf(study.methods, [&](const MethodSpec& method) {
                 return methodTable(method, folder, study.relief.resample);
               }));
  return table;
}

toml::table sweepStudy(const StudySpec& step, const StudyOptions& options, const fs::path& folder) {
  toml::table table = studyTable(StudyText{step.file, step.text}, options);
  if (toml::array* methods = table["method"].as_array()) {
    const auto& gone = step.leftOutMethods;
    for (auto entry = methods->begin(); entry != methods->end();) {
      const bool isGone =
          std::find(gone.begin(), gone.end(), methodLabel(*entry->as_table())) != gone.end();
      entry = isGone ? methods->erase(entry) : entry + 1;
    }
  }
  if (step.quick) table["study"].as_table()->insert_or_assign("quick", true);
  insertJudged(table, step, true);
  movePaths(table, studyFolder(step.file), folder);
  return table;
}

std::string studyCopyText(const toml::table& study, const fs::path& file) {
  try {
    return fmt::format(
        "{}: `gnomon run` gives them again.\n\n{}", copyMark,
        tomlText(study, {"study", "surface", "relief", "bake", "base", "truth", "sweep", "view",
                         "light", "method", "threshold", "claim", "ladder"}));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: cannot be written: {}", file.string(), error.what()));
  }
}

void requireCopyOrNothing(const fs::path& file) {
  if (!pathExists(file) || readFile(file).starts_with(copyMark)) return;
  throw InputError(fmt::format(
      "{}: a file found that no run has written; a run would replace it, --out with another folder "
      "expected",
      file.string()));
}

}  // namespace gnomon
