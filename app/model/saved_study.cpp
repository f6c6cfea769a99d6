#include "model/saved_study.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "common/vec.h"
#include "study/spec/method_changes.h"
#include "study/spec/sections/study_files.h"
#include "study/spec/study_file.h"
#include "study/spec/toml_reader.h"

namespace gnomon::app {
namespace fs = std::filesystem;
namespace {

std::vector<std::string> methodLabels(const toml::table& study) {
  std::vector<std::string> labels;
  if (const toml::array* methods = study["method"].as_array()) {
    for (const toml::node& method : *methods) {
      labels.push_back(method.is_table() ? study::methodLabel(*method.as_table()) : "");
    }
  }
  return labels;
}

std::size_t placeOf(const std::string& label, const std::vector<std::string>& labels,
                    const fs::path& file) {
  const auto found = std::find(labels.begin(), labels.end(), label);
  if (found != labels.end()) return static_cast<std::size_t>(found - labels.begin());
  throw InputError(fmt::format("{}: method \"{}\" asked for, one of {} expected", file.string(),
                               label, fmt::join(labels, ", ")));
}

template <typename Value>
void append(std::vector<std::string>& overrides, const std::string& key,
            const std::optional<Value>& value) {
  if (value) overrides.push_back(fmt::format("{}={}", key, *value));
}

void append(std::vector<std::string>& overrides, const std::string& path, const BakeChange& bake) {
  append(overrides, path + "bake.azimuths", bake.azimuths);
  append(overrides, path + "bake.bits", bake.bits);
  append(overrides, path + "bake.radius", bake.radius);
}

/// Letters, digits, - and _ alone: what a study's name may hold, since it names a folder.
std::string plainName(std::string name) {
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_') c = '-';
  }
  return name.empty() ? "saved" : name;
}

bool isNamed(const toml::table& method, const std::string& name) {
  const std::string file = method["file"].value_or(std::string());
  return study::methodLabel(method) == name || method["name"].value_or(std::string()) == name ||
         (!file.empty() && study::fileOf(file).stem() == name);
}

/// Keeps the methods that the study was opened with and, of them, those that the state has.
void keepMethods(toml::table& study, const StudyState& state) {
  toml::array* methods = study["method"].as_array();
  if (methods == nullptr) return;
  const std::vector<std::string> labels = methodLabels(study);
  for (const std::string& label : state.methods) placeOf(label, labels, state.file);
  const std::vector<std::string>& opened = state.options.methods;
  const auto isKept = [&](const toml::table& method) {
    const bool isOpened = std::any_of(opened.begin(), opened.end(), [&](const std::string& name) {
      return isNamed(method, name);
    });
    const bool isShown = std::find(state.methods.begin(), state.methods.end(),
                                   study::methodLabel(method)) != state.methods.end();
    return (opened.empty() || isOpened) && (state.methods.empty() || isShown);
  };
  for (auto entry = methods->begin(); entry != methods->end();) {
    const toml::table* method = entry->as_table();
    entry = method == nullptr || isKept(*method) ? entry + 1 : methods->erase(entry);
  }
}

/// The radius that the opened study has by its own lights, which the state may leave out.
void stateRadius(toml::table& study, const StudyState& state) {
  if (!state.light || study.at_path("bake.radius")) return;
  const double radius = study::readStudy(state.file, state.options).bake.settings.radiusTexels;
  if (!study["bake"].is_table()) study.insert_or_assign("bake", toml::table{});
  study["bake"].as_table()->insert_or_assign("radius", radius);
}

toml::array listOf(const Vec3& v) {
  return toml::array{v.x, v.y, v.z};
}

toml::table viewOf(const Camera& camera) {
  return toml::table{{"type", "camera"},
                     {"width", camera.width},
                     {"height", camera.height},
                     {"eye", listOf(camera.eye)},
                     {"target", listOf(camera.target)},
                     {"up", listOf(camera.up)},
                     {"fov", degreesOf(camera.verticalFov)}};
}

}  // namespace

std::vector<std::string> overridesOf(const StudyChanges& changes, const fs::path& file,
                                     const study::StudyOptions& options) {
  std::vector<std::string> overrides;
  append(overrides, "relief.height", changes.height);
  append(overrides, "surface.curvature", changes.curvature);
  append(overrides, "", changes.bake);
  append(overrides, "base.subdivisions", changes.subdivisions);
  if (changes.methods.empty()) return overrides;
  const std::vector<std::string> labels = methodLabels(study::studyTable(file, options));
  for (const auto& [label, change] : changes.methods) {
    const std::string path = fmt::format("method.{}.", placeOf(label, labels, file));
    append(overrides, path, change.bake);
    append(overrides, path + "base.subdivisions", change.subdivisions);
    for (const auto& [name, value] : change.parameters) {
      append(overrides, fmt::format("{}parameters.{}", path, name), std::optional(value));
    }
  }
  return overrides;
}

std::string savedStudy(const StudyState& state, const fs::path& target) {
  toml::table study = study::studyTable(state.file, state.options);
  keepMethods(study, state);
  for (const char* key : {"sweep", "threshold", "claim", "ladder"}) study.erase(key);
  study::moveFiles(study, study::studyFolder(state.file), fs::absolute(target).parent_path());
  if (toml::table* header = study["study"].as_table()) {
    header->insert_or_assign("name", plainName(target.stem().string()));
    header->insert_or_assign("ranked", false);
  }
  if (state.camera) study.insert_or_assign("view", toml::array{viewOf(*state.camera)});
  stateRadius(study, state);
  if (state.light) {
    toml::table light{{"azimuth", state.light->azimuth}, {"elevation", state.light->elevation}};
    if (state.light->radius > 0) light.insert("radius", state.light->radius);
    study.insert_or_assign("light", toml::array{light});
  }
  try {
    return study::tomlText(
        study, {"study", "surface", "relief", "bake", "base", "truth", "view", "light", "method"});
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: cannot be saved: {}", target.string(), error.what()));
  }
}

void saveStudy(const StudyState& state, const fs::path& target) {
  writeTextAtomically(target, savedStudy(state, target));
}

}  // namespace gnomon::app
