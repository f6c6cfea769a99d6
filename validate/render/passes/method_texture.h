#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "render/gl_objects.h"

namespace gnomon::render {

class Declaration;

/// A picture that a method brings: `[textures.NAME]` of its declaration.
struct MethodTexture {
  std::string name;
  std::filesystem::path file;
  bool isFiltered = true;  ///< by the GPU's own filter, where the method asks for it
  std::string about = {};

  /// `nameTexture`, the uniform.
  [[nodiscard]] std::string sampler() const { return name + "Texture"; }
};

/// The textures of a declaration.
/// @param folder  of the method, which holds them
/// @throws InputError as Declaration, and for a file that is not there or outside the folder
std::vector<MethodTexture> readTextures(const Declaration& declaration,
                                        const std::filesystem::path& folder);

/// The GLSL that gives a method its textures: uniforms, `nameAt` and `nameTexel` of each.
std::string textureAccess(const std::vector<MethodTexture>& textures);

/// A picture on the GPU: row y = 0 is its lowest. It repeats. Whole numbers of up to 8 and up to 16
/// bits stay in as many, shares of their largest; all other numbers become floats.
class GpuTexture {
 public:
  /// @throws InputError for a file that is no picture, has more than four channels, holds a number
  ///   that is not finite, or is larger than OpenGL takes; MemoryError where it does not fit in
  ///   memory
  explicit GpuTexture(const MethodTexture& texture);
  [[nodiscard]] GLuint texture() const { return texture_.name(); }
  [[nodiscard]] std::uint64_t byteCount() const { return byteCount_; }

 private:
  gl::Texture texture_;
  std::uint64_t byteCount_ = 0;
};

}  // namespace gnomon::render
