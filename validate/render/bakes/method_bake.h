#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "horizon/stored_table.h"
#include "relief/height_field.h"
#include "render/gl_objects.h"
#include "render/shader_files.h"

namespace gnomon::render {

class Declaration;

/// How a coarser level of a bake follows from the finer one: over the texels below a texel, each by
/// the area that lies below it, where the side of a level is odd.
enum class MipRule { average, minimum, maximum };

/// A table that a method bakes by a function of its own: `[bakes.NAME]` of its declaration.
///
/// The file defines `bakeName(vec2 texel)`, with layers `bakeName(vec2 texel, int layer)`, which
/// returns a float, vec2, vec3 or vec4 for the place of a texel of the bake, in texels of the map.
/// It sees the declared tables, the bakes before it and the parameters; no pixel and no light.
struct MethodBake {
  std::string name;
  int channels = 1;  ///< 1 to 4
  horizon::TableBits bits = horizon::TableBits::eight;
  /// The values that the lowest and the highest code stand for, one a channel; floats have none.
  std::vector<glm::vec2> ranges = {};
  double scale = 1;                     ///< texels of the bake per texel of the map
  std::optional<glm::ivec2> size = {};  ///< in place of the scale
  int layers = 1;
  std::vector<MipRule> mips = {};  ///< one a channel; empty: one level alone
  bool isFiltered = true;          ///< between texels; else the nearest one counts
  std::string about = {};

  /// `bakeName`, the function.
  [[nodiscard]] std::string function() const;
  /// `nameBake`, the uniform.
  [[nodiscard]] std::string sampler() const { return name + "Bake"; }
  /// Width and height over a map.
  [[nodiscard]] glm::ivec2 sizeOver(glm::ivec2 map) const;
  /// Levels of a bake of this size: one, or with mips those down to a single texel.
  [[nodiscard]] int levelsOf(glm::ivec2 of) const;
};

/// The bakes of a declaration, in the order of its lines.
/// @throws InputError as Declaration
std::vector<MethodBake> readBakes(const Declaration& declaration);

/// Every bake has its function in the code, and every function its bake.
/// @throws InputError naming file and line where one is missing
void requireBakeFunctions(const Declaration& declaration, const std::vector<MethodBake>& bakes,
                          const std::vector<ShaderPiece>& code);

/// The GLSL that gives a method its bakes: uniforms, `nameAt` and `nameTexel` of each.
std::string bakeAccess(const std::vector<MethodBake>& bakes);

/// The GLSL `main` that calls the bake functions: that of number `bakeNumber`.
std::string bakeMain(const std::vector<MethodBake>& bakes);

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
