#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "common/vec.h"
#include "surface/cage/cage.h"
#include "surface/cage/polygon_cage.h"

namespace gnomon::test {

/// Polygons that grow face by face.
struct PolygonList {
  std::vector<Vec3> positions;
  std::vector<int> faceSizes, faceVertices;
  std::vector<Vec2> uvs;
  std::vector<int> faceUvs;
  std::vector<Vec3> normals;
  std::vector<int> faceNormals;

  /// @param normal  at all corners; none where it is zero
  void add(const std::vector<int>& vertices, const std::vector<Vec2>& uv,
           const Vec3& normal = Vec3(0)) {
    faceSizes.push_back(static_cast<int>(vertices.size()));
    const bool hasNormal = normal != Vec3(0);
    if (hasNormal) normals.push_back(normal);
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      faceVertices.push_back(vertices[k]);
      faceUvs.push_back(static_cast<int>(uvs.size()));
      uvs.push_back(uv[k]);
      faceNormals.push_back(hasNormal ? static_cast<int>(normals.size()) - 1 : -1);
    }
  }

  /// The same polygons, each with vertices of its own: vertices in one place no longer have one
  /// number.
  [[nodiscard]] PolygonList apart() const {
    PolygonList own = *this;
    own.positions.clear();
    for (int& vertex : own.faceVertices) {
      own.positions.push_back(positions[static_cast<std::size_t>(vertex)]);
      vertex = static_cast<int>(own.positions.size()) - 1;
    }
    return own;
  }

  [[nodiscard]] surface::Cage cage() const {
    return surface::makePolygonCage({.positions = positions,
                                     .faceSizes = faceSizes,
                                     .faceVertices = faceVertices,
                                     .uvs = uvs,
                                     .faceUvs = faceUvs,
                                     .normals = normals,
                                     .faceNormals = faceNormals},
                                    {});
  }
};

/// Texture coordinates of a square tile, row by row in a map of 3 × 2 tiles.
inline std::vector<Vec2> tileUv(int tile) {
  const Vec2 low(tile % 3 / 3.0, tile / 3 / 2.0);
  const Vec2 size(1 / 3.0, 1 / 2.0);
  return {low, low + Vec2(size.x, 0), low + size, low + Vec2(0, size.y)};
}

enum class BoxFaces { quadrilaterals, triangles, mixed };

/// A box as an artist's program writes it: eight vertices, six faces that each have a tile of the
/// texture; with `isHard` each has its own normal, else none.
inline PolygonList boxMesh(const Vec3& low, const Vec3& high, bool isHard,
                           BoxFaces faces = BoxFaces::quadrilaterals) {
  PolygonList mesh;
  for (int corner = 0; corner < 8; ++corner) {
    mesh.positions.emplace_back(corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y,
                                corner & 4 ? high.z : low.z);
  }
  const std::array<std::array<int, 4>, 6> sides = {
      {{4, 5, 7, 6}, {1, 0, 2, 3}, {5, 1, 3, 7}, {0, 4, 6, 2}, {6, 7, 3, 2}, {0, 1, 5, 4}}};
  const std::array<Vec3, 6> normals = {Vec3(0, 0, 1),  Vec3(0, 0, -1), Vec3(1, 0, 0),
                                       Vec3(-1, 0, 0), Vec3(0, 1, 0),  Vec3(0, -1, 0)};
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const auto& [a, b, c, d] = sides.at(k);
    const Vec3 normal = isHard ? normals.at(k) : Vec3(0);
    const std::vector<Vec2> uv = tileUv(static_cast<int>(k));
    const bool isCut = faces == BoxFaces::triangles || (faces == BoxFaces::mixed && k % 2 == 1);
    if (isCut) {
      mesh.add({a, b, c}, {uv[0], uv[1], uv[2]}, normal);
      mesh.add({a, c, d}, {uv[0], uv[2], uv[3]}, normal);
    } else {
      mesh.add({a, b, c, d}, uv, normal);
    }
  }
  return mesh;
}

/// A part of a sphere about the origin as columns × rows quadrilaterals whose corners lie on it,
/// with the sphere's normals there, where makeSphere has the same part.
inline PolygonList facetedSphere(double radius, double longitudeSpan, double latitudeSpan,
                                 int columns, int rows) {
  PolygonList mesh;
  const auto vertex = [columns](int i, int j) { return j * (columns + 1) + i; };
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      const double longitude = longitudeSpan * (static_cast<double>(i) / columns - 0.5);
      const double latitude = latitudeSpan * (static_cast<double>(j) / rows - 0.5);
      mesh.normals.emplace_back(std::sin(longitude) * std::cos(latitude), std::sin(latitude),
                                std::cos(longitude) * std::cos(latitude));
      mesh.positions.push_back(radius * mesh.normals.back());
      mesh.uvs.emplace_back(static_cast<double>(i) / columns, static_cast<double>(j) / rows);
    }
  }
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      mesh.faceSizes.push_back(4);
      for (const int corner :
           {vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)}) {
        mesh.faceVertices.push_back(corner);
        mesh.faceUvs.push_back(corner);
        mesh.faceNormals.push_back(corner);
      }
    }
  }
  return mesh;
}

}  // namespace gnomon::test
