#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "horizon/stored_table.h"
#include "render/shader_files.h"

namespace gnomon::render {

class Declaration;

/// What a pass of a method's own is drawn over.
enum class PassRaster {
  texture,  ///< the texture's own plane, one pixel a texel
  light,    ///< the mesh as the light sees it, `depth_side` texels a side
  camera,   ///< the view of a camera
  filter,   ///< all texels of an earlier pass
};

/// A pass before the answer that stores values of a function of the method's: `[[pass]]` of its
/// declaration. The file defines, returning a float, vec2, vec3 or vec4,
///   texture, camera  passName(Pixel pixel)
///   light            passName(Pixel pixel, float depth)
///   filter           passName(ivec2 texel)
/// which sees the passes before it.
struct OwnPass {
  std::string name;
  PassRaster raster = PassRaster::texture;
  PassRaster root = PassRaster::texture;   ///< of a filter: of the first pass that it goes back to
  std::optional<std::size_t> source = {};  ///< of a filter: the earlier pass, by its place
  int channels = 1;                        ///< 1 to 4; 3 at most over the texture
  /// Of 8 and 16 bits values are 0 to 1; nothing: as the horizon angles that the method reads.
  std::optional<horizon::TableBits> bits = horizon::TableBits::thirtyTwo;
  bool mips = false;                ///< made by the GPU: averages
  std::array<float, 4> clear = {};  ///< where nothing is drawn
  bool resolves = false;            ///< the pass that `passes = ["texture"]` asks for
  std::string about = {};

  [[nodiscard]] std::string function() const;
  /// The uniforms of its target, and of the texel at the target's corner.
  [[nodiscard]] std::string sampler() const { return resolves ? "resolvedMap" : name + "Pass"; }
  [[nodiscard]] std::string origin() const { return resolves ? "resolvedOrigin" : name + "Origin"; }
  /// Whether a further channel, after the values, marks the texels that the surface has: by the
  /// number of the chart whose it is, in 8 and 16 bits by 1.
  [[nodiscard]] bool isMarked() const { return root == PassRaster::texture; }
  /// Of the target: some numbers of channels cannot be drawn into.
  [[nodiscard]] int storedChannels() const;
};

/// The pass that `passes = ["texture"]` asks for: `resolveTexel`, read by `resolvedAt`.
OwnPass resolvePass();

/// The passes of a declaration, in its order.
/// @throws InputError as Declaration
std::vector<OwnPass> readOwnPasses(const Declaration& declaration);

/// @throws InputError naming file and line where a pass has no function in the code
void requirePassFunctions(const Declaration& declaration, const std::vector<OwnPass>& passes,
                          const std::vector<ShaderPiece>& code);

/// The GLSL that gives a method its passes: uniforms, `nameAt` and `nameTexel` of each.
std::string passAccess(const std::vector<OwnPass>& passes);

/// The GLSL `main` that calls the function of a pass.
/// @param passes  of the method
std::string passMain(const OwnPass& pass, const std::vector<OwnPass>& passes);

}  // namespace gnomon::render
