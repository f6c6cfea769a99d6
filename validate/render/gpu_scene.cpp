#include "render/gpu_scene.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <vector>

#include "common/error.h"
#include "common/system/memory.h"
#include "render/gl_context.h"

namespace gnomon {
namespace {

/// BaseVertex as the vertex stage reads it (surface.vert).
struct GpuVertex {
  std::array<glm::vec3, 6> vectors;  // position, normal, P_x, P_y, V_1, V_2
  glm::vec2 curvatures;
  glm::vec2 texel;
  std::int32_t face;
  glm::vec2 st;
};

GpuVertex gpuVertex(const BaseVertex& v) {
  return {{glm::vec3(v.position), glm::vec3(v.normal), glm::vec3(v.px), glm::vec3(v.py),
           glm::vec3(v.v1), glm::vec3(v.v2)},
          glm::vec2(v.k1, v.k2),
          glm::vec2(v.texel),
          v.face,
          glm::vec2(v.st)};
}

void describe(GLuint layout, GLuint location, GLint components, std::size_t offset) {
  glEnableVertexArrayAttrib(layout, location);
  glVertexArrayAttribFormat(layout, location, components, GL_FLOAT, GL_FALSE,
                            static_cast<GLuint>(offset));
  glVertexArrayAttribBinding(layout, location, 0);
}

/// Past a border the outermost entries hold.
void setWrap(GLuint texture, Wrap wrap, Border border = {}) {
  const auto mode = [wrap](bool clamped) {
    return wrap == Wrap::repeat && !clamped ? GL_REPEAT : GL_CLAMP_TO_EDGE;
  };
  glTextureParameteri(texture, GL_TEXTURE_WRAP_S, mode(border.x));
  glTextureParameteri(texture, GL_TEXTURE_WRAP_T, mode(border.y));
}

GLint glLimit(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}

}  // namespace

Sphere boundingSphere(const BaseMesh& mesh) {
  Vec3 low(std::numeric_limits<double>::infinity());
  Vec3 high = -low;
  for (const BaseVertex& vertex : mesh.vertices) {
    low = glm::min(low, vertex.position);
    high = glm::max(high, vertex.position);
  }
  return {(low + high) / 2.0, glm::length(high - low) / 2};
}

GpuMesh::GpuMesh(const BaseMesh& mesh)
    : vertices_(gl::makeBuffer()),
      indices_(gl::makeBuffer()),
      layout_(gl::makeVertexArray()),
      triangleCount_(mesh.triangleCount()),
      bounds_(boundingSphere(mesh)) {
  std::vector<GpuVertex> vertices;
  vertices.reserve(mesh.vertices.size());
  for (const BaseVertex& vertex : mesh.vertices) vertices.push_back(gpuVertex(vertex));
  glNamedBufferStorage(vertices_.name(),
                       static_cast<GLsizeiptr>(vertices.size() * sizeof(GpuVertex)),
                       vertices.data(), 0);
  glNamedBufferStorage(indices_.name(),
                       static_cast<GLsizeiptr>(mesh.triangles.size() * sizeof(std::uint32_t)),
                       mesh.triangles.data(), 0);
  const GLuint layout = layout_.name();
  glVertexArrayVertexBuffer(layout, 0, vertices_.name(), 0, sizeof(GpuVertex));
  glVertexArrayElementBuffer(layout, indices_.name());
  for (GLuint k = 0; k < 6; ++k) describe(layout, k, 3, k * sizeof(glm::vec3));
  describe(layout, 6, 2, offsetof(GpuVertex, curvatures));
  describe(layout, 7, 2, offsetof(GpuVertex, texel));
  describe(layout, 9, 2, offsetof(GpuVertex, st));
  glEnableVertexArrayAttrib(layout, 8);
  glVertexArrayAttribIFormat(layout, 8, 1, GL_INT, offsetof(GpuVertex, face));
  glVertexArrayAttribBinding(layout, 8, 0);
  throwOnGlError("taking the base mesh");
}

void GpuMesh::draw() const {
  glBindVertexArray(layout_.name());
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * triangleCount_), GL_UNSIGNED_INT, nullptr);
}

GpuVolumes::GpuVolumes(const DisplacedMesh& mesh)
    : positions_(gl::makeBuffer()),
      indices_(gl::makeBuffer()),
      layout_(gl::makeVertexArray()),
      indexCount_(mesh.adjacency.size()) {
  std::vector<glm::vec3> positions;
  positions.reserve(mesh.mesh.vertices.size());
  for (const BaseVertex& vertex : mesh.mesh.vertices) positions.emplace_back(vertex.position);
  glNamedBufferStorage(positions_.name(),
                       static_cast<GLsizeiptr>(positions.size() * sizeof(glm::vec3)),
                       positions.data(), 0);
  glNamedBufferStorage(indices_.name(),
                       static_cast<GLsizeiptr>(mesh.adjacency.size() * sizeof(std::uint32_t)),
                       mesh.adjacency.data(), 0);
  glVertexArrayVertexBuffer(layout_.name(), 0, positions_.name(), 0, sizeof(glm::vec3));
  glVertexArrayElementBuffer(layout_.name(), indices_.name());
  describe(layout_.name(), 0, 3, 0);
  throwOnGlError("taking the displaced mesh");
}

void GpuVolumes::draw() const {
  glBindVertexArray(layout_.name());
  glDrawElements(GL_TRIANGLES_ADJACENCY, static_cast<GLsizei>(indexCount_), GL_UNSIGNED_INT,
                 nullptr);
}

GpuHeights::GpuHeights(const HeightField& field)
    : texture_(gl::makeTexture(GL_TEXTURE_2D)),
      byteCount_(field.texels().size() * sizeof(float)),
      bounds_(field.minimum(), field.maximum()),
      border_(field.border()) {
  const GLint largest = glLimit(GL_MAX_TEXTURE_SIZE);
  if (field.width() > largest || field.height() > largest) {
    throw InputError(fmt::format("relief: a height map of {} × {} texels, OpenGL takes at most {}",
                                 field.width(), field.height(), largest));
  }
  glTextureStorage2D(texture_.name(), 1, GL_R32F, field.width(), field.height());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTextureSubImage2D(texture_.name(), 0, 0, 0, field.width(), field.height(), GL_RED, GL_FLOAT,
                      field.texels().data());
  glTextureParameteri(texture_.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(texture_.name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  setWrap(texture_.name(), field.wrap());
  throwOnGlError("taking the height map");
}

GpuTable::GpuTable(const StoredTable& table, int width, int height, int azimuths, Wrap wrap,
                   Border border)
    : texture_(gl::makeTexture(GL_TEXTURE_3D)),
      range_(table.low, table.high - table.low),
      byteCount_(table.bytes.size()) {
  const GLint largest = glLimit(GL_MAX_3D_TEXTURE_SIZE);
  if (width > largest || height > largest || azimuths > largest) {
    throw InputError(
        fmt::format("bake: tables of {} × {} texels × {} azimuths, OpenGL takes at most {} a side",
                    width, height, azimuths, largest));
  }
  GLenum internal = GL_R8;
  GLenum type = GL_UNSIGNED_BYTE;
  if (table.bits == TableBits::sixteen) {
    internal = GL_R16;
    type = GL_UNSIGNED_SHORT;
  } else if (table.bits == TableBits::thirtyTwo) {
    internal = GL_R32F;
    type = GL_FLOAT;
    range_ = {0, 1};
  }
  glTextureStorage3D(texture_.name(), 1, internal, width, height, azimuths);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTextureSubImage3D(texture_.name(), 0, 0, 0, 0, width, height, azimuths, GL_RED, type,
                      table.bytes.data());
  glTextureParameteri(texture_.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(texture_.name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  setWrap(texture_.name(), wrap, border);
  glTextureParameteri(texture_.name(), GL_TEXTURE_WRAP_R, GL_REPEAT);
  throwOnGlError("taking a horizon table");
}

namespace {

struct PixelFormat {
  GLenum internal;
  GLenum type;
  double steps;
};

PixelFormat rgbaFormat(TableBits bits) {
  if (bits == TableBits::eight) return {GL_RGBA8, GL_UNSIGNED_BYTE, 255};
  if (bits == TableBits::sixteen) return {GL_RGBA16, GL_UNSIGNED_SHORT, 65535};
  return {GL_RGBA32F, GL_FLOAT, 0};
}

/// Values from 0 to 1 as codes of the format, rounded to nearest.
std::vector<std::uint8_t> encode(const std::vector<float>& shares, TableBits bits) {
  if (bits == TableBits::thirtyTwo) {
    std::vector<std::uint8_t> bytes(shares.size() * sizeof(float));
    std::memcpy(bytes.data(), shares.data(), bytes.size());
    return bytes;
  }
  // The extremes of a stored table are its own; two more values pin them to 0 and 1.
  std::vector<float> pinned = shares;
  pinned.insert(pinned.end(), {0.0F, 1.0F});
  std::vector<std::uint8_t> bytes = storeTable(pinned, bits).bytes;
  bytes.resize(shares.size() * static_cast<std::size_t>(bits) / 8);
  return bytes;
}

/// Four layers of `shares` ([layer][y][x]) in each RGBA map; what is missing in the last is 0.
gl::Texture rgbaMaps(const std::vector<float>& shares, int width, int height, int layers,
                     TableBits bits, std::uint64_t& byteCount) {
  const int maps = (layers + 3) / 4;
  const std::size_t texels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  std::vector<float> packed(4 * texels * static_cast<std::size_t>(maps), 0.0F);
  for (std::size_t layer = 0; layer < static_cast<std::size_t>(layers); ++layer) {
    for (std::size_t i = 0; i < texels; ++i) {
      packed[(layer / 4 * texels + i) * 4 + layer % 4] = shares[layer * texels + i];
    }
  }
  const PixelFormat format = rgbaFormat(bits);
  const std::vector<std::uint8_t> bytes = encode(packed, bits);
  byteCount = bytes.size();
  gl::Texture texture = gl::makeTexture(GL_TEXTURE_2D_ARRAY);
  glTextureStorage3D(texture.name(), 1, format.internal, width, height, maps);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTextureSubImage3D(texture.name(), 0, 0, 0, 0, width, height, maps, GL_RGBA, format.type,
                      bytes.data());
  glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return texture;
}

gl::Texture basisMaps(int azimuths, TableBits bits) {
  constexpr int side = 256;
  std::vector<double> steps;  // each texel's azimuth, in steps between those of the table
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double azimuth = std::atan2(2 * (y + 0.5) / side - 1, 2 * (x + 0.5) / side - 1);
      steps.push_back(azimuth / (2 * pi) * azimuths);
    }
  }
  std::vector<float> shares;
  shares.reserve(steps.size() * static_cast<std::size_t>(azimuths));
  for (int k = 0; k < azimuths; ++k) {
    for (const double step : steps) {
      // The shorter way round.
      const double apart = std::abs(std::remainder(step - k, double(azimuths)));
      shares.push_back(static_cast<float>(std::max(0.0, 1 - apart)));
    }
  }
  std::uint64_t ignored = 0;
  return rgbaMaps(shares, side, side, azimuths, bits, ignored);
}

gl::Texture arccosMap(double limit, TableBits bits) {
  constexpr int entries = 256;
  std::vector<float> shares;
  const double lowest = std::cos(limit);
  for (int i = 0; i < entries; ++i) {
    const double cosine = lowest + (1 - lowest) * i / (entries - 1);
    shares.push_back(static_cast<float>(std::acos(std::min(cosine, 1.0)) / limit));
  }
  std::uint64_t ignored = 0;
  return rgbaMaps(shares, entries, 1, 1, bits, ignored);
}

std::vector<float> shareOf(const AngleTable& table) {
  std::vector<float> shares(table.angles.size());
  std::transform(table.angles.begin(), table.angles.end(), shares.begin(), [&](float angle) {
    return std::clamp(static_cast<float>(angle / table.limit), 0.0F, 1.0F);
  });
  return shares;
}

}  // namespace

GpuAngles::GpuAngles(const AngleTable& table, TableBits bits)
    : azimuths_(table.azimuths),
      limit_(table.limit),
      steps_(rgbaFormat(bits).steps),
      bits_(bits),
      origin_(table.originX, table.originY),
      byteCount_(0) {
  const GLint largest = glLimit(GL_MAX_TEXTURE_SIZE);
  if (table.width > largest || table.height > largest) {
    throw InputError(fmt::format("bake: horizon angles of {} × {} texels, OpenGL takes at most {}",
                                 table.width, table.height, largest));
  }
  const int maps = (table.azimuths + 3) / 4;
  requireMemory(4.0 * 4 * maps * table.width * table.height * 2,
                fmt::format("bake: horizon angles of {} × {} texels × {} azimuths", table.width,
                            table.height, table.azimuths));
  angles_ = rgbaMaps(shareOf(table), table.width, table.height, table.azimuths, bits, byteCount_);
  basis_ = basisMaps(table.azimuths, bits);
  arccos_ = arccosMap(table.limit, bits);
  throwOnGlError("taking horizon angles");
}

}  // namespace gnomon
