#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/mask.h"
#include "relief/relief.h"
#include "render/gpu_scene.h"
#include "render/method.h"
#include "render/view.h"
#include "surface/sample_grid.h"

namespace gnomon {

/// What a pass draws, seen how, lit from where.
struct Drawing {
  const GpuMesh& mesh;
  const GpuHeights& heights;
  Wrap wrap;
  HeightSpace heightSpace;
  Vec3 light{0, 0, 1};  ///< unit vector toward the light, world
};

/// The G-buffer pass: which sample each pixel shows.
class SamplesPass {
 public:
  explicit SamplesPass(const std::filesystem::path& shaders);
  /// @throws InputError if the view is larger than GL's largest texture
  [[nodiscard]] SampleGrid render(const RenderView& view, const GpuMesh& mesh) const;

 private:
  gl::Program program_;
};

/// The picture of a mask: bump-mapped diffuse light where it is lit. RGB, 8 bits, row 0 at the top;
/// background white.
class ShadePass {
 public:
  ShadePass(const std::filesystem::path& shaders, Wrap wrap);
  [[nodiscard]] std::vector<std::uint8_t> render(const RenderView& view, const Drawing& drawing,
                                                 const Mask& mask) const;

 private:
  gl::Program program_;
};

/// How tables are filtered.
enum class TableFilter {
  exact,     ///< by hand from single texels, in float: masks do not depend on the GPU's filter
  hardware,  ///< by the GPU's own trilinear filter: what a product ships
};

/// The tables of a bake on the GPU. A method reads only those that it declares.
struct GpuTables {
  const GpuTable* horizon = nullptr;
  const GpuTable* distance = nullptr;
};

/// One method's shader.
class MethodPass {
 public:
  /// @param values  of the method's parameters; others have the authors' values
  /// @throws InputError for a shader that does not compile, or an unknown or out-of-range parameter
  MethodPass(const std::filesystem::path& shaders, const Method& method, Wrap wrap,
             TableFilter filter, const std::map<std::string, double>& values);

  /// The method's answer for every sample of the view.
  [[nodiscard]] Mask render(const RenderView& view, const Drawing& drawing,
                            const GpuTables& tables) const;

  /// Median time of one frame over at most `frames` frames, after one that warms up; milliseconds.
  /// A slow method is timed for about a second, at least one frame. By the wall clock between two
  /// glFinish: GL's timer queries of a software renderer see only a part of the work (Mesa's
  /// llvmpipe answered 0.002 ms for a frame of 15 ms).
  [[nodiscard]] double frameMilliseconds(const RenderView& view, const Drawing& drawing,
                                         const GpuTables& tables, int frames) const;

 private:
  void draw(const RenderView& view, const Drawing& drawing, const GpuTables& tables) const;

  std::string name_;
  MethodTables tables_;
  gl::Program program_;
};

}  // namespace gnomon
