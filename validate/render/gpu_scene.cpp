#include "render/gpu_scene.h"

#include <fmt/core.h>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

#include "common/error.h"
#include "common/parallel.h"
#include "common/system/memory.h"
#include "render/gl_context.h"

namespace gnomon::render {

namespace {

/// BaseVertex as the vertex stage reads it (surface.vert).
struct GpuVertex {
  std::array<glm::vec3, 6> vectors;  // position, normal, P_x, P_y, V_1, V_2
  glm::vec2 curvatures;
  glm::vec2 texel;
  std::int32_t face;
  glm::vec2 st;
  std::int32_t chart;
  glm::vec3 direction;  // of displacement
};

constexpr std::array gpuVertexLayout = {
    gl::Attribute{0, 3, 0 * sizeof(glm::vec3)},
    gl::Attribute{1, 3, 1 * sizeof(glm::vec3)},
    gl::Attribute{2, 3, 2 * sizeof(glm::vec3)},
    gl::Attribute{3, 3, 3 * sizeof(glm::vec3)},
    gl::Attribute{4, 3, 4 * sizeof(glm::vec3)},
    gl::Attribute{5, 3, 5 * sizeof(glm::vec3)},
    gl::Attribute{6, 2, offsetof(GpuVertex, curvatures)},
    gl::Attribute{7, 2, offsetof(GpuVertex, texel)},
    gl::Attribute{8, 1, offsetof(GpuVertex, face), GL_INT},
    gl::Attribute{9, 2, offsetof(GpuVertex, st)},
    gl::Attribute{10, 1, offsetof(GpuVertex, chart), GL_INT},
    gl::Attribute{11, 3, offsetof(GpuVertex, direction)},
};

GpuVertex gpuVertex(const surface::BaseVertex& v, std::int32_t chart) {
  const auto& [frame, principal, face, st] = v;
  return {{glm::vec3(frame.position), glm::vec3(frame.normal), glm::vec3(frame.px),
           glm::vec3(frame.py), glm::vec3(principal.v1), glm::vec3(principal.v2)},
          glm::vec2(principal.k1, principal.k2),
          glm::vec2(frame.texel),
          face,
          glm::vec2(st),
          chart,
          glm::vec3(frame.direction())};
}

}  // namespace

Sphere boundingSphere(const surface::BaseMesh& mesh) {
  Vec3 low(std::numeric_limits<double>::infinity());
  Vec3 high = -low;
  for (const surface::BaseVertex& vertex : mesh.vertices) {
    low = glm::min(low, vertex.frame.position);
    high = glm::max(high, vertex.frame.position);
  }
  return {(low + high) / 2.0, glm::length(high - low) / 2};
}

GpuMesh::GpuMesh(const surface::BaseMesh& mesh, const surface::TextureLayout* layout)
    : triangleCount_(mesh.triangleCount()),
      bounds_(boundingSphere(mesh)),
      chartsOverlap_(layout != nullptr && !layout->isOneToOne) {
  std::vector<GpuVertex> vertices;
  vertices.reserve(mesh.vertices.size());
  for (const surface::BaseVertex& vertex : mesh.vertices) {
    const auto face = static_cast<std::size_t>(vertex.face);
    vertices.push_back(gpuVertex(vertex, layout == nullptr ? 1 : layout->charts[face]));
  }
  vertices_ = gl::makeBuffer(std::as_bytes(std::span(vertices)));
  indices_ = gl::makeBuffer(std::as_bytes(std::span(mesh.triangles)));
  layout_ = gl::makeVertexArray(vertices_, sizeof(GpuVertex), gpuVertexLayout);
  glVertexArrayElementBuffer(layout_.name(), indices_.name());
  throwOnGlError("taking the base mesh");
}

void GpuMesh::draw() const {
  glBindVertexArray(layout_.name());
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * triangleCount_), GL_UNSIGNED_INT, nullptr);
}

GpuVolumes::GpuVolumes(const displaced::DisplacedMesh& mesh) : indexCount_(mesh.adjacency.size()) {
  std::vector<glm::vec3> positions;
  positions.reserve(mesh.mesh.vertices.size());
  for (const surface::BaseVertex& vertex : mesh.mesh.vertices)
    positions.emplace_back(vertex.frame.position);
  positions_ = gl::makeBuffer(std::as_bytes(std::span(positions)));
  indices_ = gl::makeBuffer(std::as_bytes(std::span(mesh.adjacency)));
  const std::array position = {gl::Attribute{0, 3, 0}};
  layout_ = gl::makeVertexArray(positions_, sizeof(glm::vec3), position);
  glVertexArrayElementBuffer(layout_.name(), indices_.name());
  throwOnGlError("taking the displaced mesh");
}

void GpuVolumes::draw() const {
  glBindVertexArray(layout_.name());
  glDrawElements(GL_TRIANGLES_ADJACENCY, static_cast<GLsizei>(indexCount_), GL_UNSIGNED_INT,
                 nullptr);
}

GpuHeights::GpuHeights(const relief::HeightField& field)
    : byteCount_(field.texels().size() * sizeof(float)),
      size_(field.width(), field.height()),
      bounds_(field.minimum(), field.maximum()),
      border_(field.border()) {
  const int largest = gl::limit(GL_MAX_TEXTURE_SIZE);
  if (field.width() > largest || field.height() > largest) {
    throw InputError(fmt::format("a height map of {} × {} texels, OpenGL takes at most {}",
                                 field.width(), field.height(), largest));
  }
  const gl::TextureSize size{field.width(), field.height()};
  texture_ = gl::makeTexture(GL_TEXTURE_2D, GL_R32F, size, GL_LINEAR);
  gl::fill(texture_, size, GL_RED, GL_FLOAT, field.texels().data());
  setWrap(texture_.name(), field.wrap());
  throwOnGlError("taking the height map");
}

GpuTable::GpuTable(const horizon::StoredTable& table, const horizon::TableShape& shape)
    : range_(table.low, table.high - table.low), byteCount_(table.bytes.size()) {
  const auto [width, height, layers, wrap, border] = shape;
  const int largest = gl::limit(GL_MAX_3D_TEXTURE_SIZE);
  if (width > largest || height > largest || layers > largest) {
    throw InputError(
        fmt::format("tables of {} × {} texels × {} azimuths, OpenGL takes at most {} a side", width,
                    height, layers, largest));
  }
  if (table.bits == horizon::TableBits::thirtyTwo) range_ = {0, 1};
  const PixelFormat format = pixelFormat(table.bits);
  const gl::TextureSize size{width, height, layers};
  texture_ = gl::makeTexture(GL_TEXTURE_3D, format.sized[0], size, GL_LINEAR);
  gl::fill(texture_, size, GL_RED, format.type, table.bytes.data());
  setWrap(texture_.name(), wrap, border);
  glTextureParameteri(texture_.name(), GL_TEXTURE_WRAP_R, GL_REPEAT);
  throwOnGlError("taking a horizon table");
}

namespace {

/// Values from 0 to 1 as codes of the format, rounded to nearest.
std::vector<std::uint8_t> encode(const std::vector<float>& shares, horizon::TableBits bits) {
  if (bits == horizon::TableBits::thirtyTwo) {
    std::vector<std::uint8_t> bytes(shares.size() * sizeof(float));
    std::memcpy(bytes.data(), shares.data(), bytes.size());
    return bytes;
  }
  // The extremes of a stored table are its own; two more values pin them to 0 and 1.
  std::vector<float> pinned = shares;
  pinned.insert(pinned.end(), {0.0F, 1.0F});
  std::vector<std::uint8_t> bytes = horizon::storeTable(pinned, bits).bytes;
  bytes.resize(shares.size() * static_cast<std::size_t>(bits) / 8);
  return bytes;
}

/// Four layers of `shares` ([layer][y][x]) in each RGBA map; what is missing in the last is 0.
gl::Texture rgbaMaps(const std::vector<float>& shares, int width, int height, int layers,
                     horizon::TableBits bits, std::uint64_t& byteCount) {
  const int maps = (layers + 3) / 4;
  const std::size_t texels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  std::vector<float> packed(4 * texels * static_cast<std::size_t>(maps), 0.0F);
  // Map by map: two layers of one write between each other.
  parallelFor(0, static_cast<std::size_t>(maps), [&](std::size_t map) {
    const std::size_t end = std::min<std::size_t>(4 * map + 4, static_cast<std::size_t>(layers));
    for (std::size_t layer = 4 * map; layer < end; ++layer) {
      for (std::size_t i = 0; i < texels; ++i) {
        packed[(map * texels + i) * 4 + layer % 4] = shares[layer * texels + i];
      }
    }
  });
  const std::vector<std::uint8_t> bytes = encode(packed, bits);
  byteCount = bytes.size();
  const PixelFormat format = pixelFormat(bits);
  const gl::TextureSize size{width, height, maps};
  gl::Texture texture = gl::makeTexture(GL_TEXTURE_2D_ARRAY, format.sized[3], size, GL_NEAREST);
  gl::fill(texture, size, GL_RGBA, format.type, bytes.data());
  return texture;
}

gl::Texture basisMaps(int azimuths, horizon::TableBits bits) {
  constexpr int side = 256;
  std::vector<double> steps;  // each texel's azimuth, in steps between those of the table
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double azimuth = std::atan2(2 * (y + 0.5) / side - 1, 2 * (x + 0.5) / side - 1);
      steps.push_back(azimuth / (2 * pi) * azimuths);
    }
  }
  std::vector<float> shares(steps.size() * static_cast<std::size_t>(azimuths));
  parallelFor(0, static_cast<std::size_t>(azimuths), [&](std::size_t k) {
    std::transform(steps.begin(), steps.end(), &shares[k * steps.size()], [&](double step) {
      const double apart = std::abs(step - static_cast<double>(k));
      const double shorter = std::min(apart, std::abs(azimuths - apart));  // the other way round
      return static_cast<float>(std::max(0.0, 1 - shorter));
    });
  });
  std::uint64_t ignored = 0;
  return rgbaMaps(shares, side, side, azimuths, bits, ignored);
}

gl::Texture arccosMap(double limit, horizon::TableBits bits) {
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

std::vector<float> shareOf(const horizon::AngleTable& table) {
  std::vector<float> shares(table.angles.size());
  std::transform(table.angles.begin(), table.angles.end(), shares.begin(), [&](float angle) {
    return std::clamp(static_cast<float>(angle / table.limit), 0.0F, 1.0F);
  });
  return shares;
}

}  // namespace

GpuAngles::GpuAngles(const horizon::AngleTable& table, horizon::TableBits bits)
    : azimuths_(table.layers),
      limit_(table.limit),
      steps_(pixelFormat(bits).steps),
      bits_(bits),
      origin_(table.originX, table.originY),
      byteCount_(0) {
  const int largest = gl::limit(GL_MAX_TEXTURE_SIZE);
  if (table.width > largest || table.height > largest) {
    throw InputError(fmt::format("horizon angles of {} × {} texels, OpenGL takes at most {}",
                                 table.width, table.height, largest));
  }
  const int maps = (table.layers + 3) / 4;
  requireMemory(4.0 * 4 * maps * table.width * table.height * 2,
                fmt::format("horizon angles of {} × {} texels × {} azimuths", table.width,
                            table.height, table.layers));
  angles_ = rgbaMaps(shareOf(table), table.width, table.height, table.layers, bits, byteCount_);
  basis_ = basisMaps(table.layers, bits);
  arccos_ = arccosMap(table.limit, bits);
  throwOnGlError("taking horizon angles");
}

namespace {

/// Any unit vector across a given one.
Vec3 across(const Vec3& direction) {
  const Vec3 axis = std::abs(direction.z) < 0.9 ? Vec3(0, 0, 1) : Vec3(1, 0, 0);
  return glm::normalize(glm::cross(direction, axis));
}

}  // namespace

CameraMatrices cameraMatrices(const Camera& camera, const surface::BaseMesh& mesh) {
  const Vec3 back = camera.eye - camera.target;
  if (glm::length(glm::cross(back, camera.up)) <=
      1e-9 * glm::length(back) * glm::length(camera.up)) {
    throw InputError("view: `eye`, `target` and `up` lie on one line, no camera looks that way");
  }
  const Sphere bounds = boundingSphere(mesh);
  const double distance = glm::length(camera.eye - bounds.centre);
  const double farthest = 1.01 * (distance + bounds.radius);
  const double nearest = std::max(0.99 * (distance - bounds.radius), 1e-4 * farthest);
  const double aspect = static_cast<double>(camera.width) / camera.height;
  return {glm::lookAt(camera.eye, camera.target, camera.up),
          glm::perspective(camera.verticalFov, aspect, nearest, farthest)};
}

RenderView cameraView(const Camera& camera, const surface::BaseMesh& mesh) {
  const CameraMatrices matrices = cameraMatrices(camera, mesh);
  const glm::dmat4 clip = matrices.projection * matrices.view;
  return {camera.width, camera.height, glm::mat4(clip),
          {0, 0},       {0, 0, 0, 0},  glm::vec3(camera.eye)};
}

RenderView atlasView(const surface::LimitSurface& surface, int samplesPerSide) {
  int columns = 0;
  int rows = 0;
  if (const auto grid = surface.grid()) {
    columns = grid->columns;
    rows = grid->rows;
  } else {
    columns = static_cast<int>(std::ceil(std::sqrt(surface.faceCount())));
    rows = (surface.faceCount() + columns - 1) / columns;
  }
  RenderView view;
  view.width = columns * samplesPerSide;
  view.height = rows * samplesPerSide;
  view.atlasTiles = {columns, rows};
  return view;
}

RenderView textureView(const surface::BaseMesh& mesh) {
  Vec2 low(std::numeric_limits<double>::infinity());
  Vec2 high = -low;
  for (const surface::BaseVertex& vertex : mesh.vertices) {
    low = glm::min(low, vertex.frame.texel);
    high = glm::max(high, vertex.frame.texel);
  }
  // Rounding must not add a row of texels that only a border touches.
  constexpr double slack = 1e-6;
  low = glm::floor(low + slack);
  const Vec2 size = glm::max(glm::ceil(high - slack) - low, Vec2(1));
  constexpr double longestSide = 1 << 30;
  low = glm::clamp(low, -longestSide, longestSide);
  RenderView view;
  view.width = static_cast<int>(std::min(size.x, longestSide));
  view.height = static_cast<int>(std::min(size.y, longestSide));
  view.texelWindow = glm::ivec4(glm::ivec2(low), view.width, view.height);
  return view;
}

void requireTextureView(const RenderView& view) {
  constexpr double mostTexels = 1 << 27;
  const double texels = static_cast<double>(view.width) * view.height;
  const std::string what =
      fmt::format("{} × {} unique texels on the surface", view.width, view.height);
  if (!(texels <= mostTexels)) {
    throw InputError(fmt::format("{} found, at most {} expected: fewer repeats", what, mostTexels));
  }
  constexpr double bytesPerTexel = 32;  // a sample, and what the passes keep
  requireMemory(texels * bytesPerTexel, what);
}

RenderView lightView(const Sphere& bounds, const Vec3& light, int side) {
  const double radius = 1.0001 * bounds.radius;
  const glm::dmat4 clip = glm::ortho(-radius, radius, -radius, radius, 0.0, 2 * radius) *
                          glm::lookAt(bounds.centre + radius * light, bounds.centre, across(light));
  RenderView view;
  view.width = side;
  view.height = side;
  view.clipFromWorld = glm::mat4(clip);
  return view;
}

}  // namespace gnomon::render
