#include "export/mesh_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <string_view>

#include "common/files/atomic_file.h"
#include "common/system/memory.h"

namespace gnomon::exporting {
namespace {

static_assert(sizeof(glm::vec3) == 12, "a vertex of the PLY is three floats and nothing else");

std::string plyHeader(const displaced::WeldedMesh& mesh, const std::string& comment) {
  const char* order = std::endian::native == std::endian::little ? "little" : "big";
  return fmt::format(
      "ply\nformat binary_{}_endian 1.0\ncomment {}\nelement vertex {}\nproperty float x\n"
      "property float y\nproperty float z\nelement face {}\n"
      "property list uchar int vertex_indices\nend_header\n",
      order, comment, mesh.vertices.size(), mesh.triangleCount());
}

/// The face records: a count of 3 and three indices, 13 bytes without padding.
std::string faceBytes(const displaced::WeldedMesh& mesh, std::size_t first, std::size_t count) {
  constexpr std::size_t indexBytes = 3 * sizeof(std::uint32_t);
  std::string bytes(count * (1 + indexBytes), '\3');
  for (std::size_t face = 0; face < count; ++face) {
    std::memcpy(&bytes[face * (1 + indexBytes) + 1], &mesh.triangles[3 * (first + face)],
                indexBytes);
  }
  return bytes;
}

}  // namespace

void writePly(const std::filesystem::path& path, const displaced::WeldedMesh& mesh,
              const std::string& comment) {
  writeAtomically(path, [&](int file) {
    writeAll(file, plyHeader(mesh, comment));
    writeAll(file, {reinterpret_cast<const char*>(mesh.vertices.data()),
                    mesh.vertices.size() * sizeof(glm::vec3)});
    constexpr std::size_t atOnce = 1 << 16;
    for (std::size_t first = 0; first < mesh.triangleCount(); first += atOnce) {
      writeAll(file, faceBytes(mesh, first, std::min(atOnce, mesh.triangleCount() - first)));
    }
  });
}

void writeObj(const std::filesystem::path& path, const surface::BaseMesh& mesh, Vec2 texelsPerUv,
              const std::string& comment) {
  constexpr double bytesPerVertex = 160;
  constexpr double bytesPerTriangle = 80;
  requireMemory(bytesPerVertex * static_cast<double>(mesh.vertices.size()) +
                    bytesPerTriangle * static_cast<double>(mesh.triangleCount()),
                path.string());
  std::string text = fmt::format("# {}\n", comment);
  const auto shortest = [](double value) { return static_cast<float>(value); };
  const auto append = [&](const char* key, const Vec3& v) {
    text += fmt::format("{} {} {} {}\n", key, shortest(v.x), shortest(v.y), shortest(v.z));
  };
  for (const surface::BaseVertex& vertex : mesh.vertices) {
    const Vec2 uv = vertex.frame.texel / texelsPerUv;
    append("v", vertex.frame.position);
    text += fmt::format("vt {} {}\n", shortest(uv.x), shortest(uv.y));
    append("vn", vertex.frame.normal);
  }
  for (std::size_t k = 0; k < mesh.triangles.size(); k += 3) {
    text += fmt::format("f {0}/{0}/{0} {1}/{1}/{1} {2}/{2}/{2}\n", mesh.triangles[k] + 1,
                        mesh.triangles[k + 1] + 1, mesh.triangles[k + 2] + 1);
  }
  writeTextAtomically(path, text);
}

}  // namespace gnomon::exporting
