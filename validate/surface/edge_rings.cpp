#include "surface/edge_rings.h"

#include <numeric>

#include "surface/shared_sides.h"

namespace gnomon::surface {
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
