#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/progress.h"
#include "relief/relief.h"
#include "render/bakes/method_bake.h"
#include "render/gpu_scene.h"
#include "render/method.h"
#include "render/passes/method_program.h"

namespace gnomon::render {

/// What a method's own bakes are made from, apart from its tables: no surface, no light, no view.
struct BakeScene {
  const GpuHeights& heights;
  relief::Wrap wrap;
  relief::HeightSpace heightSpace;
  double texelsPerHeight;  ///< of the frame of angles (angle_table.h)
};

/// The functions of a method that bake its own tables, compiled.
class BakePass {
 public:
  /// @param values     as of MethodPass
  /// @param endsLoops  whether loops are counted before anything is baked, see LoopCheck
  /// @throws InputError as MethodPass
  BakePass(const std::filesystem::path& shaders, const Method& method, relief::Wrap wrap,
           TableFilter filter, const std::map<std::string, double>& values, bool endsLoops = false);

  /// The parameters that may change the bakes, with their values: those that the driver did not
  /// find unused.
  [[nodiscard]] const std::map<std::string, double>& parameters() const { return used_; }

  /// Bakes every table of the method, in the order of its declaration, some rows at a time: no
  /// command to the GPU takes long, whatever the function.
  /// @param tables  those that the method declares, but for its bakes
  /// @throws InputError where a value is no finite number, a loop does not end, or a bake is larger
  /// than OpenGL takes;
  ///   MemoryError where it does not fit in memory
  [[nodiscard]] std::vector<StoredBake> bake(const BakeScene& scene, const GpuTables& tables,
                                             const Progress& progress = {}) const;

 private:
  std::string name_;
  MethodTables tables_;
  std::vector<MethodBake> bakes_;
  std::vector<OwnPass> passes_;
  std::vector<MethodTexture> textures_;
  std::vector<GpuTexture> pictures_;
  std::map<std::string, double> used_;
  gl::Program program_;
  std::optional<gl::Program> check_;  ///< of its loops
};

/// Bakes on the GPU, as a method reads them.
std::vector<GpuBake> gpuBakes(const Method& method, const std::vector<StoredBake>& stored,
                              const BakeScene& scene);

/// Refuses bakes over a map that OpenGL or memory cannot hold, before anything is made.
/// @throws InputError, MemoryError
void requireBakeSizes(const Method& method, glm::ivec2 map);

}  // namespace gnomon::render
