#include "viewer/session/scene_data.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>

#include "common/error.h"
#include "horizon/angle_table.h"
#include "study/run/scene/run_keys.h"
#include "study/spec/method_changes.h"

namespace gnomon::app {
namespace {

TableImage imageOf(std::span<const float> values, const horizon::HorizonTables& baked,
                   horizon::TableBits bits) {
  const horizon::TableShape& shape = baked;
  return {horizon::storeTable(values, bits), shape};
}

/// The entry of a cache, made by `make` where it is not there yet.
template <typename Map, typename Make>
auto cached(Map& map, const typename Map::key_type& key, const Make& make) {
  const auto found = map.find(key);
  if (found != map.end()) return found->second;
  return map.emplace(key, make()).first->second;
}

}  // namespace

SceneKeys sceneKeys(const study::StudySpec& study) {
  SceneKeys keys;
  keys.surface = study::surfaceKey(study);
  keys.relief = study::reliefKey(study);
  cache::KeyBuilder truth("viewed truth");
  truth.add("surface", keys.surface).add("relief", keys.relief);
  study::addSettings(truth, study.truth, study::Enters::scene, 1);
  keys.truth = truth.key();
  return keys;
}

std::shared_ptr<const horizon::HorizonTables> SceneMaker::bake(
    const relief::HeightField& field, const horizon::BakeSettings& settings,
    const StageProgress& progress) {
  return cached(tables_.bakes, {settings.azimuths, settings.radiusTexels}, [&] {
    return std::make_shared<const horizon::HorizonTables>(study::withKeys("bake", [&] {
      return horizon::bakeHorizons(field, settings, progress("Baking horizons"));
    }));
  });
}

std::shared_ptr<const TableImagePair> SceneMaker::pair(const relief::HeightField& field,
                                                       const study::BakeSpec& spec,
                                                       const StageProgress& progress) {
  const TableKey key(spec.settings.azimuths, spec.settings.radiusTexels, spec.bits);
  return cached(tables_.pairs, key, [&] {
    const auto baked = bake(field, spec.settings, progress);
    progress("Storing tables")(0);
    return std::make_shared<const TableImagePair>(TableImagePair{
        imageOf(baked->horizon, *baked, spec.bits), imageOf(baked->distance, *baked, spec.bits)});
  });
}

std::shared_ptr<const TableImage> SceneMaker::ellipses(const SceneData& scene,
                                                       const study::BakeSpec& spec,
                                                       const StageProgress& progress) {
  const TableKey key(spec.settings.azimuths, spec.settings.radiusTexels, spec.bits);
  return cached(tables_.ellipses, {key, scene.texelsPerHeight}, [&] {
    const auto baked = bake(*scene.heights, spec.settings, progress);
    progress("Fitting ellipses")(0);
    const horizon::EllipseTable fitted = horizon::fitEllipses(*baked, scene.texelsPerHeight);
    const horizon::TableShape& shape = fitted;
    return std::make_shared<const TableImage>(
        TableImage{horizon::storeTable(fitted.values, spec.bits), shape});
  });
}

std::shared_ptr<const horizon::AngleTable> SceneMaker::angles(const SceneData& scene,
                                                              const study::BakeSpec& spec,
                                                              const StageProgress& progress) {
  const AngleKey key(spec.settings.azimuths, spec.settings.radiusTexels, spec.angleLimit,
                     scene.texelsPerHeight);
  return cached(tables_.angles, key, [&] {
    const auto baked = bake(*scene.heights, spec.settings, progress);
    return std::make_shared<const horizon::AngleTable>(
        horizon::horizonAngles(*baked, spec.angleLimit, scene.texelsPerHeight));
  });
}

void SceneMaker::requireTried(const study::MethodSpec& spec, const render::Method& method,
                              relief::Wrap wrap) {
  const cache::ContentKey key = cache::KeyBuilder("viewed trial")
                                    .add("method", study::methodFilesKey(method))
                                    .add("filter", spec.filter)
                                    .add("wrap", wrap)
                                    .key();
  const std::string refusal = cached(trials_, key, [&]() -> std::string {
    try {
      trial_(spec, wrap);
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  });
  if (!refusal.empty()) throw InputError(refusal);
}

std::shared_ptr<const MethodData> SceneMaker::method(const SceneData& scene,
                                                     const study::MethodSpec& spec,
                                                     const StageProgress& progress) {
  MethodData data{spec, render::readMethod(spec.file), {}, {}, {}, {}, {}};
  progress("Trying methods")(0);
  requireTried(spec, data.method, scene.heights->wrap());
  data.method.isOnPolygons = scene.surface->isPolygons();
  data.mesh = study::meshOf(spec, data.method);
  data.lightMesh = study::lightMeshOf(spec, data.method);
  const render::MethodTables& declared = data.method.tables;
  if (declared.horizon || declared.distance)
    data.tables = pair(*scene.heights, spec.bake, progress);
  if (declared.angles) data.angles = angles(scene, spec.bake, progress);
  if (declared.ellipse) data.ellipses = ellipses(scene, spec.bake, progress);
  return std::make_shared<const MethodData>(std::move(data));
}

void SceneMaker::addMesh(SceneData& scene, study::MeshChoice choice, const SceneData* previous) {
  if (scene.meshes.contains(choice)) return;
  if (previous != nullptr) {
    const auto same = previous->meshes.find(choice);
    if (same != previous->meshes.end()) {
      scene.meshes.insert(*same);
      return;
    }
  }
  const relief::Relief& relief = scene.study->relief;
  MeshData data = study::withKeys("base", [&] {
    const int pieces = choice.base.subdivisions;
    return choice.kind == render::DrawnMesh::displaced
               ? MeshData{{}, displaced::makeDisplacedMesh(*scene.surface, relief, pieces)}
               : MeshData{surface::makeBaseMesh(*scene.surface, relief.texelsPerUv(), pieces,
                                                choice.base.curvature),
                          {}};
  });
  data.layout = scene.layout;
  scene.meshes.emplace(choice, std::make_shared<const MeshData>(std::move(data)));
}

void SceneMaker::forgetUnused(const SceneData& scene) {
  const auto isUnused = [](const auto& entry) { return entry.second.use_count() == 1; };
  std::erase_if(tables_.pairs, isUnused);
  std::erase_if(tables_.ellipses, isUnused);
  std::erase_if(tables_.angles, isUnused);
  std::erase_if(tables_.bakes, [&](const auto& entry) {
    return std::none_of(scene.methods.begin(), scene.methods.end(), [&](const auto& method) {
      const horizon::BakeSettings& settings = method.second->spec.bake.settings;
      return entry.first == std::pair(settings.azimuths, settings.radiusTexels);
    });
  });
}

std::shared_ptr<const SceneData> SceneMaker::make(const SceneRequest& request,
                                                  const StageProgress& progress) {
  auto scene = std::make_shared<SceneData>();
  scene->shaders = request.shaders;
  scene->soft = request.soft;
  progress("Reading the study")(0);
  scene->study = std::make_shared<const study::StudySpec>(study::readStudy(file_, request.options));
  scene->keys = sceneKeys(*scene->study);
  const bool sameSurface = last_ && last_->keys.surface == scene->keys.surface;
  const bool sameRelief = last_ && last_->keys.relief == scene->keys.relief;
  progress("Finding the limit surface")(0);
  scene->surface = sameSurface ? last_->surface
                               : std::make_shared<const surface::LimitSurface>(scene->study->cage);
  scene->layout =
      sameSurface
          ? last_->layout
          : std::make_shared<const surface::TextureLayout>(surface::textureLayout(*scene->surface));
  scene->heights = sameRelief
                       ? last_->heights
                       : std::make_shared<const relief::HeightField>(scene->study->relief.field);
  const relief::Relief& relief = scene->study->relief;
  scene->texelsPerHeight =
      sameSurface && sameRelief
          ? last_->texelsPerHeight
          : horizon::texelsPerHeight(relief.space,
                                     horizon::texelScale(*scene->surface, relief.texelsPerUv()));
  if (tablesOf_ != scene->keys.relief) tables_ = {};
  tablesOf_ = scene->keys.relief;

  const SceneData* meshes = sameSurface && sameRelief ? last_.get() : nullptr;
  progress("Cutting meshes")(0);
  addMesh(*scene, scene->standardMesh(), meshes);
  for (const study::MethodSpec& spec : scene->study->methods) {
    if (std::find(request.shown.begin(), request.shown.end(), spec.label) == request.shown.end()) {
      continue;
    }
    auto prepared = method(*scene, spec, progress);
    addMesh(*scene, prepared->mesh, meshes);
    if (prepared->lightMesh) addMesh(*scene, *prepared->lightMesh, meshes);
    scene->methods.emplace(spec.label, std::move(prepared));
  }
  if (request.directions) {
    scene->lines = sameSurface && last_->lines
                       ? last_->lines
                       : std::make_shared<const PrincipalLines>(principalLines(*scene->surface));
  }
  last_ = scene;
  forgetUnused(*scene);
  return scene;
}

}  // namespace gnomon::app
