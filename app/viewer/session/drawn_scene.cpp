#include "viewer/session/drawn_scene.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "common/error.h"
#include "render/shader_files.h"
#include "study/run/scene/run_keys.h"

namespace gnomon::app {

namespace {

render::GpuTable gpuTable(const TableImage& image) {
  return render::GpuTable(image.values, image.shape);
}

std::optional<render::GpuVolumes> volumesOf(const MeshData& data) {
  if (!data.displaced) return std::nullopt;
  return std::optional<render::GpuVolumes>(std::in_place, *data.displaced);
}

/// Keeps the entries of a map whose key is in use.
template <typename Map, typename InUse>
void keep(Map& map, const InUse& inUse) {
  std::erase_if(map, [&](const auto& entry) { return !inUse(entry.first); });
}

}  // namespace

DrawnMeshData::DrawnMeshData(const MeshData& of)
    : gpu(of.mesh(), of.layout.get()),
      volumes(volumesOf(of)),
      texture(render::textureView(of.mesh())) {}

void DrawnScene::install(std::shared_ptr<const SceneData> scene) {
  const bool again = data_ && data_->shaders != scene->shaders;
  if (!faults_ || faultsOf_ != scene->shaders) faults_.emplace(shaders_, noCache_);
  faultsOf_ = scene->shaders;
  faults_->require(render::PassKind::cameraSamples);
  faults_->require(render::PassKind::pictures);
  std::swap(data_, scene);
  try {
    heights_.try_emplace(data_->heights, *data_->heights);
    for (const auto& [choice, mesh] : data_->meshes) meshes_.try_emplace(mesh, *mesh);
    for (const auto& [label, method] : data_->methods) {
      upload(*method);
      compile(label, *method, again);
      bakeOwn(label, *method);
    }
  } catch (...) {
    std::swap(data_, scene);
    throw;
  }
  dropUnused();
}

void DrawnScene::upload(const MethodData& method) {
  if (method.tables && !pairs_.contains(method.tables)) {
    pairs_.emplace(method.tables,
                   Pair{gpuTable(method.tables->horizon), gpuTable(method.tables->distance)});
  }
  if (method.ellipses && !ellipses_.contains(method.ellipses)) {
    ellipses_.emplace(method.ellipses, gpuTable(*method.ellipses));
  }
  if (method.angles) {
    angles_.try_emplace({method.angles, method.spec.bake.bits}, *method.angles,
                        method.spec.bake.bits);
  }
}

void DrawnScene::compile(const std::string& label, const MethodData& method, bool again) {
  std::string key =
      fmt::format("{}\n{}\n{}\n{}\n{}\n{}", method.spec.file.string(),
                  static_cast<int>(method.spec.filter), static_cast<int>(data_->heights->wrap()),
                  method.spec.disc, data_->soft, method.method.isOnPolygons);
  for (const auto& [name, value] : method.spec.parameters) {
    key += fmt::format("\n{}={}", name, value);
  }
  const auto found = passes_.find(label);
  if (!again && found != passes_.end() && found->second.key == key) return;
  try {
    if (!isDrawnRight(label, method)) return;
    render::MethodPass pass(shaders_, method.method, data_->heights->wrap(), method.spec.filter,
                            method.spec.parameters,
                            method.spec.disc ? render::SoftAnswer::disc : render::SoftAnswer::own);
    passes_.erase(label);
    passes_.emplace(label, Compiled{key, std::move(pass)});
    errors_.erase(label);
  } catch (const InputError& error) {
    errors_[label] = error.what();
  }
}

cache::ContentKey DrawnScene::bakesKey(const MethodData& method) const {
  cache::KeyBuilder key("viewed bakes");
  key.add("relief", data_->keys.relief).add("texelsPerHeight", data_->texelsPerHeight);
  key.add("files", study::methodFilesKey(method.method)).add("shaders", data_->shaders);
  key.add("filter", method.spec.filter);
  for (const auto& [name, value] : method.spec.parameters) {
    key.add("parameter", name).add("value", value);
  }
  key.add("bake", study::settingsKey(method.spec.bake, study::Enters::everything));
  if (method.method.tables.surfaceAngles) key.add("angles", anglesKey(method));
  return key.key();
}

void DrawnScene::bakeOwn(const std::string& label, const MethodData& method) {
  if (method.method.bakes.empty()) {
    ownBakes_.erase(label);
    return;
  }
  const cache::ContentKey key = bakesKey(method);
  const auto found = ownBakes_.find(label);
  const bool isThere = found != ownBakes_.end() && found->second.key == key;
  if (isThere || lacksAngles(label) || errors_.contains(label)) return;
  ownBakes_.erase(label);
  try {
    const render::GpuHeights& heights = heights_.at(data_->heights);
    const render::BakeScene from{heights, data_->heights->wrap(), data_->study->relief.space,
                                 data_->texelsPerHeight};
    render::requireBakeSizes(method.method, heights.size());
    const render::BakePass pass(shaders_, method.method, from.wrap, method.spec.filter,
                                method.spec.parameters);
    ownBakes_.emplace(
        label, OwnBakes{key, render::gpuBakes(method.method,
                                              pass.bake(from, tablesOf(label, method)), from)});
  } catch (const Error& error) {
    errors_[label] = error.what();
  }
}

bool DrawnScene::isDrawnRight(const std::string& label, const MethodData& method) {
  const std::string fault = faults_->faultOf(method.spec, data_->soft);
  if (fault.empty()) return true;
  errors_[label] = fmt::format("{} is not shown: {}", label, fault);
  passes_.erase(label);
  return false;
}

void DrawnScene::dropUnused() {
  const auto used = [&](const auto& isOf) {
    return std::any_of(data_->methods.begin(), data_->methods.end(),
                       [&](const auto& method) { return isOf(*method.second); });
  };
  keep(heights_, [&](const auto& key) { return key == data_->heights; });
  keep(meshes_, [&](const auto& key) {
    return std::any_of(data_->meshes.begin(), data_->meshes.end(),
                       [&](const auto& mesh) { return mesh.second == key; });
  });
  keep(pairs_, [&](const auto& key) {
    return used([&](const MethodData& method) { return method.tables == key; });
  });
  keep(ellipses_, [&](const auto& key) {
    return used([&](const MethodData& method) { return method.ellipses == key; });
  });
  keep(angles_, [&](const auto& key) {
    return used([&](const MethodData& method) {
      return method.angles == key.first && method.spec.bake.bits == key.second;
    });
  });
  std::erase_if(errors_, [&](const auto& error) { return !data_->methods.contains(error.first); });
  std::erase_if(ownBakes_, [&](const auto& own) { return !data_->methods.contains(own.first); });
}

cache::ContentKey DrawnScene::anglesKey(const MethodData& method) const {
  const study::MeshChoice& mesh = method.mesh;
  return cache::KeyBuilder("viewed angles")
      .add("surface", data_->keys.truth)
      .add("mesh", mesh.kind)
      .add("subdivisions", mesh.base.subdivisions)
      .add("bake",
           study::settingsKey(method.spec.bake, study::Enters::shotAngles | study::Enters::codes))
      .key();
}

bool DrawnScene::installAngles(const std::string& label, const cache::ContentKey& key,
                               const horizon::AngleTable& table) {
  const auto method = data_->methods.find(label);
  if (method == data_->methods.end() || anglesKey(*method->second) != key) return false;
  ownAngles_.erase(label);
  ownAngles_.emplace(label,
                     OwnAngles{key, render::GpuAngles(table, method->second->spec.bake.bits)});
  bakeOwn(label, *method->second);
  return true;
}

bool DrawnScene::lacksAngles(const std::string& label) const {
  const auto method = data_->methods.find(label);
  if (method == data_->methods.end() || !method->second->method.tables.surfaceAngles) return false;
  const auto found = ownAngles_.find(label);
  return found == ownAngles_.end() || found->second.key != anglesKey(*method->second);
}

const DrawnMeshData& DrawnScene::mesh(study::MeshChoice choice) const {
  return meshes_.at(data_->meshes.at(choice));
}

render::Drawing DrawnScene::drawing(study::MeshChoice choice, const Light& light) const {
  const DrawnMeshData& drawn = mesh(choice);
  return {drawn.gpu,
          heights_.at(data_->heights),
          data_->heights->wrap(),
          data_->study->relief.space,
          data_->texelsPerHeight,
          light,
          drawn.volumes ? &*drawn.volumes : nullptr,
          &drawn.texture};
}

render::Drawing DrawnScene::drawing(const MethodData& method, const Light& light) const {
  render::Drawing drawn = drawing(method.mesh, light);
  if (method.lightMesh) drawn.lightMesh = &mesh(*method.lightMesh).gpu;
  return drawn;
}

render::GpuTables DrawnScene::tablesOf(const std::string& label, const MethodData& method) const {
  render::GpuTables tables;
  tables.searchRadius = method.spec.bake.settings.radiusTexels;
  if (method.tables) {
    tables.horizon = &pairs_.at(method.tables).horizon;
    tables.distance = &pairs_.at(method.tables).distance;
  }
  if (method.ellipses) tables.ellipse = &ellipses_.at(method.ellipses);
  if (method.angles) tables.angles = &angles_.at({method.angles, method.spec.bake.bits});
  const auto own = ownAngles_.find(label);
  if (method.method.tables.surfaceAngles && own != ownAngles_.end()) {
    tables.angles = &own->second.angles;
  }
  return tables;
}

std::optional<DrawnScene::Ready> DrawnScene::method(const std::string& label) const {
  if (!data_) return std::nullopt;
  const auto found = data_->methods.find(label);
  const auto pass = passes_.find(label);
  if (found == data_->methods.end() || pass == passes_.end()) return std::nullopt;
  const MethodData& method = *found->second;
  render::GpuTables tables = tablesOf(label, method);
  if (method.method.tables.surfaceAngles && tables.angles == nullptr) return std::nullopt;
  if (!method.method.bakes.empty()) {
    const auto own = ownBakes_.find(label);
    if (own == ownBakes_.end()) return std::nullopt;
    tables.bakes = &own->second.bakes;
  }
  return Ready{&method, &pass->second.pass, tables};
}

namespace fs = std::filesystem;

ShaderWatch::ShaderWatch(fs::path shaders)
    : shaders_(std::move(shaders)), last_(times()), looked_(Clock::now()) {}

ShaderWatch::Times ShaderWatch::times() const {
  Times times;
  const auto add = [&](const fs::path& file) {
    std::error_code error;
    const auto time = fs::last_write_time(file, error);
    if (!error) times.emplace_back(file, time);
  };
  std::error_code ignored;
  for (const auto& entry : fs::recursive_directory_iterator(shaders_, ignored)) {
    if (render::isShader(entry)) add(entry.path());
  }
  for (const fs::path& file : files_) add(file);
  std::sort(times.begin(), times.end());
  return times;
}

void ShaderWatch::watch(std::vector<fs::path> files) {
  if (files == files_) return;
  files_ = std::move(files);
  last_ = times();
}

bool ShaderWatch::changed() {
  constexpr auto pause = std::chrono::milliseconds(500);
  if (Clock::now() - looked_ < pause) return false;
  looked_ = Clock::now();
  Times now = times();
  const bool differ = now != last_;
  last_ = std::move(now);
  return differ;
}

}  // namespace gnomon::app
