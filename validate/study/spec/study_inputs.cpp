#include "study/spec/study_inputs.h"

#include <algorithm>
#include <string>

#include "common/files/atomic_file.h"
#include "common/files/input_file.h"
#include "common/text/sha256.h"
#include "render/method.h"
#include "render/shader_files.h"
#include "study/spec/mask_files.h"
#include "study/spec/sections/study_paths.h"

namespace gnomon::study {
namespace fs = std::filesystem;
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
    files.push_back({Kind::mesh, home / pathOf(mesh->path)});
  }
  if (const ImageMap* image = imageOf(study.reliefSection)) {
    files.push_back({Kind::image, home / pathOf(image->path)});
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
      records.push_back(
          {kind, isGivenStream(file) ? file.string() : pathFrom(file, folder), sha256(study.text)});
      continue;
    }
    const fs::path inside = file.lexically_relative(shaders);
    const bool isOurs = kind == Kind::shader && !inside.empty() && *inside.begin() != "..";
    const std::string name =
        isOurs ? (fs::path("shaders") / inside).generic_string() : pathFrom(file, folder);
    const auto isSame = [&](const InputRecord& input) { return input.file == name; };
    if (std::any_of(records.begin(), records.end(), isSame)) continue;
    records.push_back({kind, name, sha256(readFile(file))});
  }
  return records;
}

}  // namespace gnomon::study
