#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "horizon/stored_table.h"
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

}  // namespace gnomon::render
