#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "common/vec.h"
#include "surface/cage/cage.h"

namespace gnomon::surface {

/// Catmull-Clark by the rules of the paper on a closed mesh of quadrilaterals, and the limit masks
/// of Halstead, Kass & DeRose 1993. Shares nothing with OpenSubdiv.
struct PlainSubdivision {
  struct Face {
    std::array<int, 4> vertices;
    std::array<Vec2, 4> st;
    int cageFace;
  };
  std::vector<Vec3> positions;
  std::vector<Face> faces;

  explicit PlainSubdivision(const Cage& cage) : positions(cage.positions) {
    for (int f = 0; f < cage.faceCount(); ++f) {
      Face face{{}, {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)}, f};
      for (std::size_t k = 0; k < 4; ++k) {
        face.vertices[k] = cage.faceVertices[4 * static_cast<std::size_t>(f) + k];
      }
      faces.push_back(face);
    }
  }

  [[nodiscard]] const Vec3& at(int vertex) const {
    return positions[static_cast<std::size_t>(vertex)];
  }

  void step() {
    const std::size_t old = positions.size();
    std::vector<Vec3> facePoints;
    std::vector<Vec3> faceSum(old, Vec3(0)), midSum(old, Vec3(0));
    std::vector<int> valence(old, 0);
    std::map<std::pair<int, int>, Vec3> edgeFaceSum;
    for (const Face& face : faces) {
      Vec3 centre(0);
      for (const int v : face.vertices) centre += at(v) / 4.0;
      facePoints.push_back(centre);
      for (std::size_t k = 0; k < 4; ++k) {
        const int a = face.vertices[k];
        const int b = face.vertices[(k + 1) % 4];
        const auto i = static_cast<std::size_t>(a);
        faceSum[i] += centre;
        midSum[i] += (at(a) + at(b)) / 2.0;  // each edge leaves the vertex in one face
        ++valence[i];
        edgeFaceSum.try_emplace(std::minmax(a, b), Vec3(0)).first->second += centre;
      }
    }
    std::vector<Vec3> next(old);
    for (std::size_t i = 0; i < old; ++i) {
      const double n = valence[i];
      next[i] = (faceSum[i] / n + 2.0 * midSum[i] / n + (n - 3) * positions[i]) / n;
    }
    std::map<std::pair<int, int>, int> edgePoint;
    for (const auto& [edge, sum] : edgeFaceSum) {
      edgePoint[edge] = static_cast<int>(next.size());
      next.push_back((at(edge.first) + at(edge.second) + sum) / 4.0);
    }
    std::vector<Face> children;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const Face& face = faces[f];
      const int middle = static_cast<int>(next.size());
      next.push_back(facePoints[f]);
      const auto edge = [&](std::size_t k) {
        return edgePoint.at(std::minmax(face.vertices[k % 4], face.vertices[(k + 1) % 4]));
      };
      const auto half = [&](std::size_t k) {
        return (face.st[k % 4] + face.st[(k + 1) % 4]) / 2.0;
      };
      const Vec2 centre = (face.st[0] + face.st[2]) / 2.0;
      for (std::size_t k = 0; k < 4; ++k) {
        children.push_back({{face.vertices[k], edge(k), middle, edge(k + 3)},
                            {face.st[k], half(k), centre, half(k + 3)},
                            face.cageFace});
      }
    }
    positions = std::move(next);
    faces = std::move(children);
  }

  /// Keeps the faces that lie within `reach` of a corner of the cage, where that corner is a vertex
  /// of theirs. Rules that miss a neighbour then spoil the rim: by one ring a step.
  void crop(const Cage& cage, int corner, double reach) {
    constexpr std::array<Vec2, 4> places = {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
    const auto isFar = [&](const Face& face) {
      for (std::size_t k = 0; k < 4; ++k) {
        if (cage.faceVertices[4 * static_cast<std::size_t>(face.cageFace) + k] != corner) continue;
        const Vec2 offset = glm::abs((face.st[0] + face.st[2]) / 2.0 - places[k]);
        return std::max(offset.x, offset.y) > reach;
      }
      return true;
    };
    faces.erase(std::remove_if(faces.begin(), faces.end(), isFar), faces.end());
  }

  [[nodiscard]] std::vector<Vec3> limits() const {
    std::vector<Vec3> edges(positions.size(), Vec3(0)), corners(positions.size(), Vec3(0));
    std::vector<int> valence(positions.size(), 0);
    for (const Face& face : faces) {
      for (std::size_t k = 0; k < 4; ++k) {
        const auto i = static_cast<std::size_t>(face.vertices[k]);
        edges[i] += at(face.vertices[(k + 1) % 4]);
        corners[i] += at(face.vertices[(k + 2) % 4]);
        ++valence[i];
      }
    }
    std::vector<Vec3> result;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const double n = valence[i];
      result.push_back((n * n * positions[i] + 4.0 * edges[i] + corners[i]) / (n * (n + 5)));
    }
    return result;
  }
};

}  // namespace gnomon::surface
