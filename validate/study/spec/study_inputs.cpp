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

class Inputs {
 public:
  explicit Inputs(const fs::path& folder) : folder_(folder), shaders_(render::shaderFolder()) {}

  void add(Kind kind, const fs::path& file) {
    const fs::path inside = file.lexically_relative(shaders_);
    const bool isOurs = kind == Kind::shader && !inside.empty() && *inside.begin() != "..";
    const std::string name =
        isOurs ? (fs::path("shaders") / inside).generic_string() : pathFrom(file, folder_);
    const auto isSame = [&](const InputRecord& input) { return input.file == name; };
    if (std::any_of(list.begin(), list.end(), isSame)) return;
    list.push_back({kind, name, sha256(readFile(file))});
  }

  /// Of the text that was run, whatever the file holds by now.
  void addStudy(const StudySpec& study) {
    const bool isStream = isGivenStream(study.file);
    list.push_back({Kind::study, isStream ? study.file.string() : pathFrom(study.file, folder_),
                    sha256(study.text)});
  }

  void addCommonShaders() {
    for (const fs::path& file : render::shadersIn(shaders_ / "common")) add(Kind::shader, file);
  }

  /// A method's file, and those that it brings.
  void addMethod(const fs::path& file) {
    add(Kind::shader, file);
    const render::Method method = render::readMethod(file);
    for (const render::ShaderPiece& include : method.includes) add(Kind::shader, include.file);
    for (const render::MethodTexture& texture : method.textures) add(Kind::image, texture.file);
  }

  std::vector<InputRecord> list;

 private:
  fs::path folder_;
  fs::path shaders_;
};

}  // namespace

std::vector<InputRecord> studyInputs(const StudySpec& study, const fs::path& folder) {
  const fs::path home = studyFolder(study.file);
  Inputs inputs(folder);
  inputs.addStudy(study);
  if (const auto* mesh = std::get_if<SurfaceMesh>(&study.surfaceSection)) {
    inputs.add(Kind::mesh, home / pathOf(mesh->path));
  }
  if (const ImageMap* image = imageOf(study.reliefSection)) {
    inputs.add(Kind::image, home / pathOf(image->path));
  }
  inputs.addCommonShaders();
  for (const MethodSpec& method : study.methods) {
    if (!method.isGiven()) inputs.addMethod(method.file);
    for (const GivenMaskFile& mask : givenMaskFiles(study, method)) {
      inputs.add(Kind::mask, mask.path);
    }
  }
  for (const LadderSpec& ladder : study.ladders) {
    for (const auto* states : {&ladder.forward, &ladder.backward}) {
      for (const MethodSpec& state : *states) inputs.addMethod(state.file);
    }
  }
  return std::move(inputs.list);
}

}  // namespace gnomon::study
