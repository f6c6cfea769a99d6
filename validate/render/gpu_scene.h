#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <limits>

#include "common/camera.h"
#include "displaced/displaced_mesh.h"
#include "horizon/angle_table.h"
#include "horizon/stored_table.h"
#include "relief/relief.h"
#include "render/gl_objects.h"
#include "surface/base_mesh.h"
#include "surface/limit_surface.h"
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

/// The projection of a mesh into a picture, which determines the view's samples.
struct RenderView {
  int width = 0;   ///< pixels
  int height = 0;  ///< pixels
  glm::mat4 clipFromWorld{1};
  /// Columns and rows of face tiles for an atlas, zero for a camera.
  glm::ivec2 atlasTiles{0, 0};
  /// Of a texture's own plane: the texel coordinates of its lower left corner, and its size in
  /// texels; zero for other views.
  glm::ivec4 texelWindow{0, 0, 0, 0};
  /// Of a camera, world; no number for other views.
  glm::vec3 eye{std::numeric_limits<float>::quiet_NaN()};
};

/// The camera as OpenGL has it: clip = projection · view · (x, y, z, 1), all three right-handed but
/// clip space; the camera looks along -z of view space with +y up, depth runs from -1 (near) to 1.
struct CameraMatrices {
  glm::dmat4 view;        ///< camera from world
  glm::dmat4 projection;  ///< clip from camera
};

/// Near and far hold the mesh's bounding sphere.
/// @throws InputError as `cameraView`
CameraMatrices cameraMatrices(const Camera& camera, const surface::BaseMesh& mesh);

/// One sample a pixel, as Figure 8 shows the surface; faces turned from the camera are not drawn.
/// @throws InputError if the eye is at the target or `up` points along the view
RenderView cameraView(const Camera& camera, const surface::BaseMesh& mesh);

/// A regular grid of `samplesPerSide`² samples over every face's parameters, each face a square
/// tile; a grid chart keeps its faces side by side, others fill rows of a square. Parameters of
/// sample (i, j) of a face: ((i + 0.5) / samplesPerSide, (j + 0.5) / samplesPerSide), t upward.
RenderView atlasView(const surface::LimitSurface& surface, int samplesPerSide);

/// The texture's own plane, one pixel a texel: all texels that the mesh's texture coordinates
/// reach, each unique. Where charts overlap, one of them shows. Sides end at 2³⁰.
RenderView textureView(const surface::BaseMesh& mesh);

/// @throws InputError if the view has more than 2²⁷ texels, MemoryError if they cannot fit
void requireTextureView(const RenderView& view);

/// The mesh as a directional light sees it: an orthographic picture of its bounding sphere, depth 0
/// where the sphere is nearest to the light, 1 where it is farthest.
/// @param light  unit vector toward the light
RenderView lightView(const Sphere& bounds, const Vec3& light, int side);

}  // namespace gnomon::render
