#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "cache/cache.h"
#include "horizon/horizon_bake.h"
#include "render/bakes/method_bake.h"
#include "render/gpu_scene.h"
#include "render/method.h"
#include "render/passes/method_pass.h"
#include "render/passes/method_program.h"
#include "study/run/scene/base_case.h"
#include "study/run/scene/environment.h"
#include "study/run/scene/run_keys.h"
#include "study/run/scene/view_samples.h"
#include "study/spec/study_file.h"
#include "surface/limit_surface.h"
#include "surface/sample_grid.h"
#include "surface/texture_layout.h"

namespace gnomon::study {

/// What a compiled shader takes in the driver, about.
constexpr std::uint64_t programBytes = 1 << 20;

/// The horizon and distance table of one bake on the GPU, in the bits of one method.
struct TablePair {
  render::GpuTable horizon;
  render::GpuTable distance;
};

/// Shoots the displaced surface's own horizons.
using HorizonShooter = std::function<horizon::AngleTable()>;

/// The tables that a study's methods ask for: every bake is done once, if the cache does not have
/// it, and stored once for each number of bits. References stay valid while the set lives.
class TableSet {
 public:
  /// All must outlive it.
  /// @param texelsPerHeight  of the frame of angles (angle_table.h)
  TableSet(const relief::HeightField& field, double texelsPerHeight, cache::Cache& cache,
           const RunKeys& keys)
      : field_(field), texelsPerHeight_(texelsPerHeight), cache_(cache), keys_(keys) {}

  /// @param clock  of the stages "bake" and "tables"
  const TablePair& tables(const BakeSpec& spec, StageClock& clock);
  /// Horizon angles of the flat relief.
  const render::GpuAngles& angles(const BakeSpec& spec, StageClock& clock);
  /// Horizon angles of the displaced surface, at the texels that a mesh shows.
  /// @param shoot  asked where there are none yet
  const render::GpuAngles& surfaceAngles(const BakeSpec& spec, const MeshChoice& mesh,
                                         const HorizonShooter& shoot);
  /// Elliptical cones of light, fitted to the horizons of the bake.
  const render::GpuTable& ellipses(const BakeSpec& spec, StageClock& clock);

 private:
  const horizon::HorizonTables& bake(const BakeSpec& spec, StageClock& clock);

  const relief::HeightField& field_;
  double texelsPerHeight_;
  cache::Cache& cache_;
  const RunKeys& keys_;
  // By the settings that enter each, see settingsKey.
  std::map<cache::ContentKey, std::shared_ptr<const horizon::HorizonTables>> bakes_;
  std::map<cache::ContentKey, std::shared_ptr<const TablePair>> stored_;
  std::map<cache::ContentKey, render::GpuTable> ellipses_;
  std::map<cache::ContentKey, std::shared_ptr<const render::GpuAngles>> angles_;
  std::map<std::pair<MeshChoice, cache::ContentKey>, std::shared_ptr<const render::GpuAngles>>
      surfaceAngles_;
};

/// Whether a bake is small enough to stay in memory as a whole, and to be kept on disk.
bool keepsHorizons(const relief::HeightField& field, const horizon::BakeSettings& settings);

/// bakeHorizons, or what the cache has of it. The cache has none that is baked in 0.05 s.
horizon::HorizonTables keptHorizons(cache::Cache& cache, const relief::HeightField& field,
                                    const BakeSpec& bake, const Progress& progress);

/// What all methods of a run share: the limit surface, the relief with its tables, and the meshes
/// that are drawn with their samples and truths. Every part is made once, when it is first asked
/// for; references stay valid while the scene lives.
struct RunScene {
  /// @param clock  of the stages "surface", "samples", "bake" and "tables"; outlives the scene
  /// @param kept   what earlier runs and scenes left; outlives the scene
  RunScene(const StudySpec& of, StageClock& stageClock, const render::GlContext& gl,
           cache::Cache& kept);

  const StudySpec& study;
  StageClock& clock;
  cache::Cache& cache;
  std::filesystem::path shaders;
  RunKeys keys;
  std::shared_ptr<const surface::LimitSurface> ownedSurface;
  const surface::LimitSurface& surface;
  std::shared_ptr<const surface::TextureLayout> layout;  ///< of the surface
  double texelsPerHeight;                                ///< of the frame of angles (angle_table.h)
  render::GpuHeights heights;
  TableSet tables;
  std::map<MeshChoice, BaseCase> bases;
  /// Meshes that are drawn from the light alone.
  std::map<MeshChoice, OnDemand<std::shared_ptr<const DrawnBase>>> lightMeshes;

  /// A mesh with its views, built if it is not there yet.
  BaseCase& base(MeshChoice choice);
  /// A mesh without its views, built if it is not there yet.
  const DrawnBase& mesh(MeshChoice choice);
  /// The study's own base mesh: the one that is shown and whose truth is tested.
  BaseCase& standardBase();
  [[nodiscard]] MeshChoice standardMesh() const;

  /// What a pass needs to draw a base mesh under one of the study's lights.
  [[nodiscard]] render::Drawing drawing(const BaseCase& on, std::size_t light) const;
  /// The points of the samples of one view, for its light fields; null where they are too many to
  /// be kept.
  [[nodiscard]] std::shared_ptr<const FieldPoints> fieldPoints(const BaseCase& on,
                                                               std::size_t view) const;
  /// The steps along which shadows are measured in one view under one light; those made last are
  /// kept. May be called from any thread, by one at a time.
  /// @param points  of `fieldPoints`
  std::shared_ptr<const compare::LightField> lightField(const BaseCase& on, std::size_t view,
                                                        std::size_t light,
                                                        const FieldPoints* points);
  /// The bins of the samples of one view under one light; those of a study alone are kept.
  [[nodiscard]] SampleBins bins(const BaseCase& on, std::size_t view, std::size_t light) const;

 private:
  struct LastField {
    const BaseCase* base = nullptr;
    std::size_t view = 0, light = 0;
    std::shared_ptr<const compare::LightField> field;
  };
  LastField last_;
};

/// The tables that a method bakes by its own functions: what the cache has of them, else baked,
/// as part of the stage "bake". Null for a method without any.
/// @param tables  those that the method declares in addition to them
/// @throws InputError as render::BakePass
std::shared_ptr<const std::vector<render::GpuBake>> methodBakes(RunScene& scene,
                                                                const MethodSpec& spec,
                                                                const render::Method& method,
                                                                const render::GpuTables& tables);

}  // namespace gnomon::study
