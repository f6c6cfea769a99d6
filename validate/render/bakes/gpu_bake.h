#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "horizon/stored_table.h"
#include "relief/height_field.h"
#include "render/bakes/method_bake.h"
#include "render/gl_handles.h"

namespace gnomon::render {

/// A method's own bake as a texture stores it: level by level, in each [layer][y][x][channel], row
/// y = 0 at v = 0. Codes of 8 and 16 bits stand for 0 to 1, the range of their channel.
struct StoredBake {
  int width = 0;   ///< of the first level, texels
  int height = 0;  ///< likewise
  int layers = 0;
  int channels = 0;
  int levels = 0;
  horizon::StoredTable values;

  /// Width and height of a level.
  [[nodiscard]] glm::ivec2 sizeOf(int level) const {
    return glm::max(glm::ivec2(width >> level, height >> level), glm::ivec2(1));
  }
  /// Values of all layers of a level.
  [[nodiscard]] std::size_t entriesOf(int level) const;
  /// Where a level begins.
  [[nodiscard]] std::size_t entry(int level) const;
};

/// Bytes of a bake over a map, all its levels.
std::uint64_t bytesOver(const MethodBake& bake, glm::ivec2 map);

/// A bake of this size with all values 0.
StoredBake emptyBake(const MethodBake& bake, glm::ivec2 map);

/// The next coarser level of one layer of a bake, see MipRule.
/// @param values  of the finer level, [y][x][channel]
std::vector<float> coarser(std::span<const float> values, glm::ivec2 size,
                           const std::vector<MipRule>& rules);

/// A bake as a texture, an array of layers.
class GpuBake {
 public:
  /// @param isFiltered  whether the GPU's own filter mixes texels, where a method asks for it
  GpuBake(const StoredBake& bake, relief::Wrap wrap, relief::Border border, bool isFiltered);
  [[nodiscard]] GLuint texture() const { return texture_.name(); }
  [[nodiscard]] std::uint64_t byteCount() const { return byteCount_; }

 private:
  gl::Texture texture_;
  std::uint64_t byteCount_;
};

}  // namespace gnomon::render
