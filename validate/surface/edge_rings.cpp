#include "surface/edge_rings.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>
#include <utility>

namespace gnomon {
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

/// An edge between two vertices, as one face has it.
struct FaceEdge {
  int low, high;
  std::size_t pair;  ///< of opposite edges: 2 face for those along s, 2 face + 1 along t

  friend bool operator<(const FaceEdge& a, const FaceEdge& b) {
    return std::tie(a.low, a.high, a.pair) < std::tie(b.low, b.high, b.pair);
  }
};

std::vector<FaceEdge> sortedEdges(const LimitSurface& surface) {
  const auto faces = static_cast<std::size_t>(surface.faceCount());
  std::vector<FaceEdge> edges;
  edges.reserve(4 * faces);
  for (std::size_t face = 0; face < faces; ++face) {
    const std::array<int, 4> corners = surface.corners(static_cast<int>(face));
    for (std::size_t side = 0; side < 4; ++side) {
      const auto [low, high] = std::minmax(corners.at(side), corners.at((side + 1) % 4));
      edges.push_back({low, high, 2 * face + side % 2});
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

}  // namespace

EdgeRings makeEdgeRings(const LimitSurface& surface) {
  EdgeRings rings;
  rings.faces.resize(static_cast<std::size_t>(surface.faceCount()));
  DisjointSets sets(2 * rings.faces.size());
  const std::vector<FaceEdge> edges = sortedEdges(surface);
  for (std::size_t i = 1; i < edges.size(); ++i) {
    const FaceEdge& a = edges[i - 1];
    const FaceEdge& b = edges[i];
    if (a.low == b.low && a.high == b.high) sets.unite(a.pair, b.pair);
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

}  // namespace gnomon
