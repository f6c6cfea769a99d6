#include "study/spec/resolved_study.h"

#include <fmt/core.h>

#include <algorithm>
#include <string_view>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "common/files/input_file.h"
#include "render/method.h"
#include "render/shader_files.h"
#include "study/spec/method_changes.h"
#include "study/spec/sections/method_section.h"
#include "study/spec/sections/study_files.h"
#include "study/spec/toml_reader.h"

namespace gnomon::study {

namespace fs = std::filesystem;
namespace {

constexpr std::string_view copyMark = "# The study of the results in this folder, as Gnomon ran it";

std::string copyStem(const std::string& study) {
  std::string stem = study;
  std::replace_if(
      stem.begin(), stem.end(), [](char c) { return !isNameCharacter(c); }, '-');
  return stem;
}

/// `triangles` holds where nothing else says how finely the surface is cut.
toml::table truthTable(const StudySpec& study) {
  toml::table table = settingsOf(study.truth, study.relief.resample);
  if (study.truth.stepTexels) table.erase("triangles");
  return table;
}

/// The header of the copy, which is the full form of what was run.
toml::table headerTable(const StudySpec& study) {
  StudyHeader header = study;
  header.name = copyStem(study.name);
  toml::table table = settingsOf(header);
  table.erase("quick");
  if (header.suite.empty()) table.erase("suite");
  return table;
}

template <typename Entries, typename ToTable>
toml::array tablesOf(const Entries& entries, const ToTable& toTable) {
  toml::array array;
  for (const auto& entry : entries) array.push_back(toTable(entry));
  return array;
}

/// What a run judges, as the file has it.
void insertJudged(toml::table& table, const StudySpec& study) {
  const auto written = [](const auto& entry) { return entry.written; };
  const auto insert = [&](const char* key, toml::array array) {
    table.erase(key);
    if (!array.empty()) table.insert(key, std::move(array));
  };
  insert("threshold", tablesOf(study.thresholds, [](const Gate& gate) {
           return std::get<Threshold>(gate.origin).written;
         }));
  insert("claim", tablesOf(study.claims, written));
  insert("ladder", tablesOf(study.ladders, written));
}

}  // namespace

std::string studyCopyName(const std::string& study) {
  return copyStem(study) + ".toml";
}

toml::table resolvedStudy(const StudySpec& study, const fs::path& folder) {
  const fs::path home = studyFolder(study.file);
  const int resample = study.relief.resample;
  toml::table table{{"study", headerTable(study)},
                    {"surface", tableOf(study.surfaceSection)},
                    {"relief", tableOf(study.reliefSection)},
                    {"bake", settingsOf(study.bake, resample)},
                    {"base", settingsOf(study.base)},
                    {"truth", truthTable(study)},
                    {"view", tablesOf(study.views, [](const ViewSpec& v) { return tableOf(v); })},
                    {"light", tablesOf(study.lights, [](const Light& light) {
                       return settingsOf(sectionOf(light));
                     })}};
  insertJudged(table, study);
  moveFiles(table, home, folder);
  table.insert("method", tablesOf(study.methods, [&](const MethodSpec& method) {
                 return tableOf(method, folder, resample);
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
  insertJudged(table, step);
  moveFiles(table, studyFolder(step.file), folder);
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
  if (!isThere(file)) return;
  try {
    if (readFile(file).starts_with(copyMark)) return;
  } catch (const InputError&) {
    // Another run that writes into the folder has just taken it away.
    if (!isThere(file)) return;
    throw;
  }
  throw InputError(fmt::format(
      "{}: a file found that no run has written; a run would replace it, --out with another folder "
      "expected",
      file.string()));
}

namespace {

using Kind = InputRecord::Kind;

struct InputFile {
  Kind kind;
  fs::path path;
};

/// A method's file, and those that it brings.
void addMethod(const fs::path& file, std::vector<InputFile>& files) {
  files.push_back({Kind::shader, file});
  const render::Method method = render::readMethod(file);
  for (const render::ShaderPiece& include : method.includes) {
    files.push_back({Kind::shader, include.file});
  }
  for (const render::MethodTexture& texture : method.textures) {
    files.push_back({Kind::image, texture.file});
  }
}

std::vector<InputFile> filesOf(const StudySpec& study) {
  const fs::path home = studyFolder(study.file);
  std::vector<InputFile> files = {{Kind::study, study.file}};
  if (const auto* mesh = std::get_if<SurfaceMesh>(&study.surfaceSection)) {
    files.push_back({Kind::mesh, home / fileOf(mesh->path)});
  }
  if (const ImageMap* image = imageOf(study.reliefSection)) {
    files.push_back({Kind::image, home / fileOf(image->path)});
  }
  for (const fs::path& file : render::shadersIn(render::shaderFolder() / "common")) {
    files.push_back({Kind::shader, file});
  }
  for (const MethodSpec& method : study.methods) {
    if (!method.isGiven()) addMethod(method.file, files);
    for (const GivenMaskFile& mask : givenMaskFiles(study, method)) {
      files.push_back({Kind::mask, mask.path});
    }
  }
  for (const LadderSpec& ladder : study.ladders) {
    for (const auto* states : {&ladder.forward, &ladder.backward}) {
      for (const MethodSpec& state : *states) addMethod(state.file, files);
    }
  }
  return files;
}

}  // namespace

std::vector<fs::path> inputFiles(const StudySpec& study) {
  std::vector<fs::path> paths;
  for (InputFile& file : filesOf(study)) paths.push_back(std::move(file.path));
  return paths;
}

std::vector<InputRecord> studyInputs(const StudySpec& study, const fs::path& folder) {
  const fs::path shaders = render::shaderFolder();
  std::vector<InputRecord> records;
  for (const auto& [kind, file] : filesOf(study)) {
    if (kind == Kind::study) {
      // Of the text that was run, whatever the file holds by now.
      records.push_back({kind, isGivenStream(file) ? file.string() : relativeFile(file, folder),
                         sha256(study.text)});
      continue;
    }
    const fs::path inside = file.lexically_relative(shaders);
    const bool isOurs = kind == Kind::shader && !inside.empty() && *inside.begin() != "..";
    const std::string name =
        isOurs ? (fs::path("shaders") / inside).generic_string() : relativeFile(file, folder);
    const auto isSame = [&](const InputRecord& input) { return input.file == name; };
    if (std::any_of(records.begin(), records.end(), isSame)) continue;
    records.push_back({kind, name, sha256(readFile(file))});
  }
  return records;
}

}  // namespace gnomon::study
