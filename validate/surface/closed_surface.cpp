#include "surface/closed_surface.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>

namespace gnomon::surface {

bool isClosed(const LimitSurface& surface) {
  return 2 * sharedSides(surface).size() == 4 * static_cast<std::size_t>(surface.faceCount());
}

double enclosedVolume(const LimitSurface& surface) {
  // By the divergence theorem: a sixth of the triple products of all triangles' corners. A nearby
  // origin keeps them exact.
  const Vec3 origin = surface.tangentPoint(0, 0, 0).position;
  double sixfold = 0;
  for (int face = 0; face < surface.faceCount(); ++face) {
    const auto at = [&](double s, double t) {
      return surface.tangentPoint(face, s, t).position - origin;
    };
    const Vec3 middle = at(0.5, 0.5);
    const std::array corners = {at(0, 0), at(1, 0), at(1, 1), at(0, 1)};
    for (std::size_t k = 0; k < 4; ++k) {
      sixfold += glm::dot(middle, glm::cross(corners.at(k), corners.at((k + 1) % 4)));
    }
  }
  return sixfold / 6;
}

namespace {

/// A side with its two cage vertices, the lower first.
struct VertexSide {
  int low, high;
  FaceSide of;
  bool rises;  ///< whether it runs from the lower vertex to the higher

  [[nodiscard]] bool isAt(const VertexSide& other) const {
    return low == other.low && high == other.high;
  }

  [[nodiscard]] auto order() const { return std::tie(low, high, of.face, of.side); }
};

}  // namespace

std::vector<SharedSide> sharedSides(const LimitSurface& surface) {
  std::vector<VertexSide> sides;
  sides.reserve(4 * static_cast<std::size_t>(surface.faceCount()));
  for (int face = 0; face < surface.faceCount(); ++face) {
    const std::array<int, 4> corners = surface.corners(face);
    for (std::size_t k = 0; k < 4; ++k) {
      const int from = corners.at(k);
      const int to = corners.at((k + 1) % 4);
      sides.push_back(
          {std::min(from, to), std::max(from, to), {face, static_cast<int>(k)}, from < to});
    }
  }
  std::sort(sides.begin(), sides.end(),
            [](const VertexSide& a, const VertexSide& b) { return a.order() < b.order(); });
  std::vector<SharedSide> shared;
  // At an edge of polygons any number of faces may meet, and two may run in the same direction.
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].isAt(sides[begin])) ++end;
    if (end - begin != 2 || sides[begin].rises == sides[begin + 1].rises) continue;
    shared.push_back({sides[begin].of, sides[begin + 1].of});
  }
  return shared;
}

namespace {

/// Disjoint sets of the numbers 0 to n - 1 (Galler & Fischer 1964), paths halved on the way.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parents_(count) {
    std::iota(parents_.begin(), parents_.end(), std::size_t{0});
  }
  std::size_t find(std::size_t member) {
    while (parents_[member] != member) {
      parents_[member] = parents_[parents_[member]];
      member = parents_[member];
    }
    return member;
  }
  void unite(std::size_t a, std::size_t b) { parents_[find(a)] = find(b); }

 private:
  std::vector<std::size_t> parents_;
};

}  // namespace

EdgeRings makeEdgeRings(const LimitSurface& surface) {
  EdgeRings rings;
  rings.faces.resize(static_cast<std::size_t>(surface.faceCount()));
  DisjointSets sets(2 * rings.faces.size());
  // A face's pairs of opposite edges: 2 face along s, 2 face + 1 along t.
  const auto pairOf = [](const FaceSide& edge) {
    return static_cast<std::size_t>(2 * edge.face + edge.side % 2);
  };
  for (const auto& [first, second] : sharedSides(surface)) {
    sets.unite(pairOf(first), pairOf(second));
  }
  std::vector<int> numbers(2 * rings.faces.size(), -1);
  const auto ringOf = [&](std::size_t pair) {
    int& number = numbers[sets.find(pair)];
    if (number < 0) number = rings.count++;
    return number;
  };
  for (std::size_t face = 0; face < rings.faces.size(); ++face) {
    rings.faces[face].s = ringOf(2 * face);
    rings.faces[face].t = ringOf(2 * face + 1);
  }
  return rings;
}

}  // namespace gnomon::surface
