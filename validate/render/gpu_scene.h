#pragma once

#include <cstdint>

#include "displaced/displaced_mesh.h"
#include "horizon/angle_table.h"
#include "horizon/table_file.h"
#include "relief/relief.h"
#include "render/gl_handles.h"
#include "surface/base_mesh.h"
#include "surface/texture_layout.h"

namespace gnomon::render {

/// A ball in the world.
struct Sphere {
  Vec3 centre;
  double radius;
};

/// The sphere about the box of a mesh's vertices.
Sphere boundingSphere(const surface::BaseMesh& mesh);

/// A mesh in GL buffers.
class GpuMesh {
 public:
  /// @param layout  of the mesh's surface; without it all faces are one chart
  explicit GpuMesh(const surface::BaseMesh& mesh, const surface::TextureLayout* layout = nullptr);
  [[nodiscard]] const Sphere& bounds() const { return bounds_; }
  [[nodiscard]] std::size_t triangleCount() const { return triangleCount_; }
  /// Whether charts of its texture overlap: a texel may belong to another chart than a pixel.
  [[nodiscard]] bool chartsOverlap() const { return chartsOverlap_; }
  void draw() const;

 private:
  gl::Buffer vertices_;
  gl::Buffer indices_;
  gl::VertexArray layout_;
  std::size_t triangleCount_;
  Sphere bounds_;
  bool chartsOverlap_;
};

/// A displaced mesh in GL buffers, every triangle with its neighbours, for shadow volumes.
class GpuVolumes {
 public:
  explicit GpuVolumes(const displaced::DisplacedMesh& mesh);
  void draw() const;

 private:
  gl::Buffer positions_;
  gl::Buffer indices_;
  gl::VertexArray layout_;
  std::size_t indexCount_;
};

/// The height map as a 32-bit float texture: the same numbers as truth and bake use.
class GpuHeights {
 public:
  /// @throws InputError if the map is larger than GL's largest texture
  explicit GpuHeights(const relief::HeightField& field);
  [[nodiscard]] GLuint texture() const { return texture_.name(); }
  [[nodiscard]] std::uint64_t byteCount() const { return byteCount_; }
  /// Width and height, texels.
  [[nodiscard]] glm::ivec2 size() const { return size_; }
  /// The lowest and the highest texel, height units.
  [[nodiscard]] glm::vec2 bounds() const { return bounds_; }
  [[nodiscard]] relief::Border border() const { return border_; }

 private:
  gl::Texture texture_;
  std::uint64_t byteCount_;
  glm::ivec2 size_;
  glm::vec2 bounds_;
  relief::Border border_;
};

/// A table as a 3-D texture in its stored bits.
class GpuTable {
 public:
  /// @throws InputError if a side is larger than GL's largest 3-D texture
  GpuTable(const horizon::StoredTable& table, const horizon::TableShape& shape);
  [[nodiscard]] GLuint texture() const { return texture_.name(); }
  [[nodiscard]] std::uint64_t byteCount() const { return byteCount_; }
  /// low and high - low: a normalised code c stands for low + c · (high - low).
  [[nodiscard]] glm::vec2 range() const { return range_; }

 private:
  gl::Texture texture_;
  glm::vec2 range_;
  std::uint64_t byteCount_;
};

/// Horizon angles, four azimuths in the channels of one RGBA map, as Sloan & Cohen 2000 (§4.1) pack
/// eight into two; with the two lookup textures that go with them. All in the table's own bits.
class GpuAngles {
 public:
  /// @throws InputError if a side is larger than GL's largest texture
  GpuAngles(const horizon::AngleTable& table, horizon::TableBits bits);
  [[nodiscard]] GLuint texture() const { return angles_.name(); }
  /// Their basis maps, B_k(s, t): 1 where (s, t), -1 to 1 over the map, points toward azimuth k,
  /// falling off evenly in angle to 0 at the azimuths beside it.
  [[nodiscard]] GLuint basis() const { return basis_.name(); }
  /// Their one-dimensional map from a cosine, cos(limit) to 1, to the angle, as a share of `limit`.
  [[nodiscard]] GLuint arccos() const { return arccos_.name(); }
  [[nodiscard]] int azimuths() const { return azimuths_; }
  [[nodiscard]] double limit() const { return limit_; }
  /// Codes of one channel, 2^bits - 1; 0 for floats.
  [[nodiscard]] double steps() const { return steps_; }
  [[nodiscard]] horizon::TableBits bits() const { return bits_; }
  [[nodiscard]] glm::ivec2 origin() const { return origin_; }
  [[nodiscard]] std::uint64_t byteCount() const { return byteCount_; }

 private:
  gl::Texture angles_;
  gl::Texture basis_;
  gl::Texture arccos_;
  int azimuths_;
  double limit_;
  double steps_;
  horizon::TableBits bits_;
  glm::ivec2 origin_;
  std::uint64_t byteCount_;
};

}  // namespace gnomon::render
