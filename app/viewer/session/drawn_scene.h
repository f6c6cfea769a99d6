#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/bakes/bake_pass.h"
#include "render/passes/drawing.h"
#include "render/passes/method_pass.h"
#include "study/run/method_trial.h"
#include "viewer/session/scene_data.h"

namespace gnomon::app {

/// A mesh on the GPU.
struct DrawnMeshData {
  explicit DrawnMeshData(const MeshData& of);
  render::GpuMesh gpu;
  std::optional<render::GpuVolumes> volumes;
  render::RenderView texture;  ///< the texture's own plane
};

/// A scene on the GPU. Parts that the next scene has too are kept. All members need the context.
class DrawnScene {
 public:
  explicit DrawnScene(std::filesystem::path shaders) : shaders_(std::move(shaders)) {}

  /// Uploads a scene in the place of the one before, which stays where that fails, and compiles
  /// its methods: all of them where shaders have changed, else those that are new. One that does
  /// not compile stays as it was; one that the driver would draw wrong is not drawn.
  /// @throws InputError for what is larger than OpenGL takes, DriverError where the driver draws
  ///   the pixels or the pictures wrong that all methods need
  void install(std::shared_ptr<const SceneData> scene);
  /// What the horizons of a method hang on that are shot on the displaced surface.
  [[nodiscard]] cache::ContentKey anglesKey(const MethodData& method) const;
  /// Gives a method the horizons that were shot for it.
  /// @param key  of what they were shot for; they are dropped where the method asks for others now
  /// @return whether they were taken
  bool installAngles(const std::string& label, const cache::ContentKey& key,
                     const horizon::AngleTable& table);

  [[nodiscard]] const SceneData* data() const { return data_.get(); }
  [[nodiscard]] std::shared_ptr<const SceneData> sharedData() const { return data_; }
  [[nodiscard]] const DrawnMeshData& mesh(study::MeshChoice choice) const;
  [[nodiscard]] render::Drawing drawing(study::MeshChoice choice, const Light& light) const;
  /// What the passes of a method draw.
  [[nodiscard]] render::Drawing drawing(const MethodData& method, const Light& light) const;

  /// A method with its tables, if all of it is there.
  struct Ready {
    const MethodData* data;
    const render::MethodPass* pass;
    render::GpuTables tables;
  };
  [[nodiscard]] std::optional<Ready> method(const std::string& label) const;
  /// The method waits for horizons that are shot on the displaced surface.
  [[nodiscard]] bool lacksAngles(const std::string& label) const;
  /// Why a method is not drawn as its file has it, by label: what its last compilation said, or
  /// what the driver draws wrong. Those that went well are not in it.
  [[nodiscard]] const std::map<std::string, std::string>& errors() const { return errors_; }

 private:
  struct Pair {
    render::GpuTable horizon;
    render::GpuTable distance;
  };
  struct Compiled {
    std::string key;  ///< file, filter, wrap, disc, whether a share is asked, and parameters
    render::MethodPass pass;
  };
  struct OwnAngles {
    cache::ContentKey key;  ///< of the surface and the bake that they were shot for
    render::GpuAngles angles;
  };
  /// The tables that a method bakes by its own functions.
  struct OwnBakes {
    cache::ContentKey key;  ///< of what they were baked from
    std::vector<render::GpuBake> bakes;
  };
  void compile(const std::string& label, const MethodData& method, bool again);
  /// Bakes a method's own tables again where what they are made from has changed. One whose bake
  /// fails is not drawn.
  void bakeOwn(const std::string& label, const MethodData& method);
  [[nodiscard]] cache::ContentKey bakesKey(const MethodData& method) const;
  /// The method's tables, as far as they are there, but for its own.
  [[nodiscard]] render::GpuTables tablesOf(const std::string& label,
                                           const MethodData& method) const;
  /// Whether the driver draws a method right; otherwise it is no longer drawn.
  bool isDrawnRight(const std::string& label, const MethodData& method);
  void upload(const MethodData& method);
  void dropUnused();

  std::filesystem::path shaders_;
  cache::Cache noCache_;
  std::optional<study::DriverFaults> faults_;
  int faultsOf_ = 0;  ///< the shaders that they are of: see SceneRequest
  std::shared_ptr<const SceneData> data_;
  std::map<std::shared_ptr<const relief::HeightField>, render::GpuHeights> heights_;
  std::map<std::shared_ptr<const MeshData>, DrawnMeshData> meshes_;
  std::map<std::shared_ptr<const TableImagePair>, Pair> pairs_;
  std::map<std::shared_ptr<const TableImage>, render::GpuTable> ellipses_;
  std::map<std::pair<std::shared_ptr<const horizon::AngleTable>, horizon::TableBits>,
           render::GpuAngles>
      angles_;
  std::map<std::string, OwnAngles> ownAngles_;
  std::map<std::string, OwnBakes> ownBakes_;
  std::map<std::string, Compiled> passes_;
  std::map<std::string, std::string> errors_;
};

/// Notices that a shader's file has changed, by its time, twice a second at most.
class ShaderWatch {
 public:
  explicit ShaderWatch(std::filesystem::path shaders);

  /// Also these files, wherever they are: methods of the person's own.
  void watch(std::vector<std::filesystem::path> files);
  /// Whether a file has changed, come or gone since the last call.
  bool changed();

 private:
  using Clock = std::chrono::steady_clock;
  using Times = std::vector<std::pair<std::filesystem::path, std::filesystem::file_time_type>>;
  [[nodiscard]] Times times() const;

  std::filesystem::path shaders_;
  std::vector<std::filesystem::path> files_;
  Times last_;
  Clock::time_point looked_;
};

}  // namespace gnomon::app
