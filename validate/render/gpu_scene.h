#pragma once

#include <cstdint>

#include "relief/relief.h"
#include "relief/table_file.h"
#include "render/gl_handles.h"
#include "surface/base_mesh.h"

namespace gnomon {

/// A base mesh in GL buffers.
class GpuMesh {
 public:
  explicit GpuMesh(const BaseMesh& mesh);
  [[nodiscard]] std::size_t triangleCount() const { return triangleCount_; }
  void draw() const;

 private:
  gl::Buffer vertices_;
  gl::Buffer indices_;
  gl::VertexArray layout_;
  std::size_t triangleCount_;
};

/// The height map as a 32-bit float texture: what truth and bake use, to the bit.
class GpuHeights {
 public:
  /// @throws InputError if the map is larger than GL's largest texture
  explicit GpuHeights(const HeightField& field);
  [[nodiscard]] GLuint texture() const { return texture_.name(); }
  [[nodiscard]] std::uint64_t byteCount() const { return byteCount_; }
  /// The lowest and the highest texel, height units.
  [[nodiscard]] glm::vec2 bounds() const { return bounds_; }

 private:
  gl::Texture texture_;
  std::uint64_t byteCount_;
  glm::vec2 bounds_;
};

/// A horizon or distance table as a 3-D texture of one layer an azimuth, in its stored bits.
class GpuTable {
 public:
  /// @throws InputError if a side is larger than GL's largest 3-D texture
  GpuTable(const StoredTable& table, int width, int height, int azimuths, Wrap wrap);
  [[nodiscard]] GLuint texture() const { return texture_.name(); }
  [[nodiscard]] std::uint64_t byteCount() const { return byteCount_; }
  /// low and high - low: a normalised code c stands for low + c · (high - low).
  [[nodiscard]] glm::vec2 range() const { return range_; }

 private:
  gl::Texture texture_;
  glm::vec2 range_;
  std::uint64_t byteCount_;
};

}  // namespace gnomon
