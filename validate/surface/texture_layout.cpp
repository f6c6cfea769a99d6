#include "surface/texture_layout.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "common/parallel.h"
#include "surface/closed_surface.h"

namespace gnomon::surface {
namespace {

/// What is left of a triangle's area after so small a part is none.
constexpr double nothing = 1e-12;
// Where many charts are stacked a triangle is not cut on once others cover it so many times over,
// those that cut nothing from it counting an eighth, nor once it is in so many pieces: its share is
// then what they cover.
constexpr double mostCovers = 4;
constexpr std::size_t mostPieces = 1024;

double cross(Vec2 a, Vec2 b) {
  return a.x * b.y - a.y * b.x;
}

/// The sign of a sum of doubles, exact: Shewchuk's expansions, whose parts do not overlap and
/// grow, so that the last one that is not 0 has the sign of all.
int signOfSum(const std::array<double, 12>& terms) {
  std::array<double, 12> parts{};
  std::size_t count = 0;
  for (double term : terms) {
    for (std::size_t k = 0; k < count; ++k) {
      const double sum = parts.at(k) + term;
      const double back = sum - parts.at(k);
      parts.at(k) = (parts.at(k) - (sum - back)) + (term - back);
      term = sum;
    }
    parts.at(count++) = term;
  }
  for (std::size_t k = count; k-- > 0;) {
    if (parts.at(k) != 0) return parts.at(k) > 0 ? 1 : -1;
  }
  return 0;
}

using Polygon = std::vector<Vec2>;  ///< convex, counter-clockwise

double areaOf(const Polygon& polygon) {
  double twice = 0;
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    twice += cross(polygon[k] - polygon[0], polygon[k + 1] - polygon[0]);
  }
  return twice / 2;
}

/// The part of a polygon on one side of the line from a to b: on the left for side 1, else for -1.
Polygon partOf(const Polygon& polygon, Vec2 a, Vec2 b, double side) {
  const auto height = [&](Vec2 place) { return side * cross(b - a, place - a); };
  Polygon part;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec2 from = polygon[k];
    const Vec2 to = polygon[(k + 1) % polygon.size()];
    const double before = height(from);
    const double after = height(to);
    if (before >= 0) part.push_back(from);
    if ((before > 0 && after < 0) || (before < 0 && after > 0)) {
      part.push_back(glm::mix(from, to, before / (before - after)));
    }
  }
  return part;
}

/// What is left of a triangle while others are taken away.
class Rest {
 public:
  explicit Rest(const TextureTriangle& triangle)
      : whole_(triangle.begin(), triangle.end()), pieces_{whole_}, area_(areaOf(whole_)) {}

  /// The area that was taken away.
  [[nodiscard]] double taken() const {
    double left = 0;
    for (const Polygon& piece : pieces_) left += areaOf(piece);
    return area_ - left;
  }

  /// @returns whether to take away more
  bool takeAway(const TextureTriangle& other) {
    std::vector<Polygon> left;
    bool isCut = false;
    for (Polygon& piece : pieces_) {
      std::vector<Polygon> outside;
      if (cut(piece, other, &outside) > 0) {
        isCut = true;
        std::move(outside.begin(), outside.end(), std::back_inserter(left));
      } else {
        left.push_back(std::move(piece));
      }
    }
    pieces_ = std::move(left);
    covers_ += cut(whole_, other, nullptr) / area_ / (isCut ? 1 : 8);
    return !pieces_.empty() && pieces_.size() < mostPieces && covers_ < mostCovers;
  }

 private:
  /// The area of a polygon that lies under a triangle, 0 where that is next to nothing.
  /// @param outside  receives the rest in pieces; may be null
  double cut(Polygon inside, const TextureTriangle& other, std::vector<Polygon>* outside) const {
    const double least = nothing * area_;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 a = other.at(k);
      const Vec2 b = other.at((k + 1) % 3);
      if (outside != nullptr) {
        Polygon out = partOf(inside, a, b, -1);
        if (areaOf(out) > least) outside->push_back(std::move(out));
      }
      inside = partOf(inside, a, b, 1);
      if (!(areaOf(inside) > least)) return 0;
    }
    return areaOf(inside);
  }

  Polygon whole_;
  std::vector<Polygon> pieces_;
  double area_;
  double covers_ = 0;  ///< how many times over it is covered
};

bool areSeparated(const TextureTriangle& a, const TextureTriangle& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    const auto isBeyond = [&](Vec2 place) {
      return orientation(a.at(k), a.at((k + 1) % 3), place) <= 0;
    };
    if (std::all_of(b.begin(), b.end(), isBeyond)) return true;
  }
  return false;
}

/// Of convex polygons whose interiors do not meet, an edge of one separates them.
bool overlap(const TextureTriangle& a, const TextureTriangle& b) {
  return !areSeparated(a, b) && !areSeparated(b, a);
}

struct Box {
  Vec2 low{std::numeric_limits<double>::infinity()};
  Vec2 high{-std::numeric_limits<double>::infinity()};

  void add(Vec2 place) {
    low = glm::min(low, place);
    high = glm::max(high, place);
  }
  [[nodiscard]] bool meets(const Box& other) const {
    return low.x < other.high.x && other.low.x < high.x && low.y < other.high.y &&
           other.low.y < high.y;
  }
};

Box boxOf(const TextureTriangle& triangle) {
  Box box;
  for (const Vec2 corner : triangle) box.add(corner);
  return box;
}

/// The triangles of all cage faces in a tree of boxes, by whose halves those near a triangle are
/// found.
class TriangleTree {
 public:
  struct Entry {
    TextureTriangle corners;
    Box box;
    std::size_t face;  ///< of the cage
  };

  explicit TriangleTree(std::vector<Entry> entries) : entries_(std::move(entries)) {
    if (!entries_.empty()) build(0, entries_.size());
  }

  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }

  /// Calls `visit` with each other triangle that overlaps one and that is `wanted`, until it
  /// returns false.
  template <typename Wanted, typename Visit>
  void forEachOver(const Entry& entry, const Wanted& wanted, const Visit& visit) const {
    std::vector<std::size_t> open;
    if (!nodes_.empty()) open.push_back(0);
    while (!open.empty()) {
      const Node& node = nodes_[open.back()];
      const std::size_t next = open.back() + 1;
      open.pop_back();
      if (!node.box.meets(entry.box)) continue;
      if (node.right != 0) {
        open.push_back(node.right);
        open.push_back(next);
        continue;
      }
      for (std::size_t k = node.begin; k < node.end; ++k) {
        const Entry& other = entries_[k];
        if (&other == &entry || !wanted(other) || !other.box.meets(entry.box)) continue;
        if (overlap(entry.corners, other.corners) && !visit(other)) return;
      }
    }
  }

 private:
  struct Node {
    Box box;
    std::size_t begin, end;
    std::size_t right;  ///< the second half's node, after all of the first; 0 of a leaf
  };

  void build(std::size_t begin, std::size_t end) {
    constexpr std::size_t leaf = 4;
    const std::size_t place = nodes_.size();
    Box box;
    for (std::size_t k = begin; k < end; ++k) {
      box.add(entries_[k].box.low);
      box.add(entries_[k].box.high);
    }
    nodes_.push_back({box, begin, end, 0});
    if (end - begin <= leaf) return;
    const Vec2 size = box.high - box.low;
    const auto middle = [along = size.x > size.y ? 0 : 1](const Entry& entry) {
      return entry.box.low[along] / 2 + entry.box.high[along] / 2;
    };
    const std::size_t half = begin + (end - begin) / 2;
    const auto at = [&](std::size_t k) {
      return entries_.begin() + static_cast<std::ptrdiff_t>(k);
    };
    std::nth_element(at(begin), at(half), at(end),
                     [&](const Entry& a, const Entry& b) { return middle(a) < middle(b); });
    build(begin, half);
    nodes_[place].right = nodes_.size();
    build(half, end);
  }

  std::vector<Entry> entries_;
  std::vector<Node> nodes_;
};

/// The cage's faces as they lie in the texture.
class FacesInTexture {
 public:
  explicit FacesInTexture(const LimitSurface& surface)
      : surface_(surface),
        perFace_(surface.facesPerCageFace()),
        count_(static_cast<std::size_t>(surface.faceCount() / perFace_)),
        turns_(count_),
        tree_(trianglesOfAll()) {}

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] const TriangleTree& tree() const { return tree_; }
  [[nodiscard]] std::size_t cageFace(int face) const {
    return static_cast<std::size_t>(face / perFace_);
  }

  /// For every face those that go on where it ends.
  [[nodiscard]] std::vector<std::vector<std::size_t>> continued() const {
    std::vector<std::vector<std::size_t>> next(count_);
    for (const auto& [first, second] : sharedSides(surface_)) {
      const std::size_t a = cageFace(first.face);
      const std::size_t b = cageFace(second.face);
      const bool isContinued = a != b && turns_[a] != 0 && turns_[a] == turns_[b] &&
                               uvAt(first.face, first.side) == uvAt(second.face, second.side + 1) &&
                               uvAt(first.face, first.side + 1) == uvAt(second.face, second.side);
      if (!isContinued) continue;
      next[a].push_back(b);
      next[b].push_back(a);
    }
    return next;
  }

  /// Its area in the world, by two points along s and t of every face of the limit surface.
  [[nodiscard]] double worldArea(std::size_t cageFace) const {
    const double off = std::sqrt(1.0 / 12);
    double sum = 0;
    for (int k = 0; k < perFace_; ++k) {
      const int face = static_cast<int>(cageFace) * perFace_ + k;
      for (const double s : {0.5 - off, 0.5 + off}) {
        for (const double t : {0.5 - off, 0.5 + off}) {
          const TangentPoint point = surface_.tangentPoint(face, s, t);
          sum += glm::length(glm::cross(point.ds, point.dt)) / 4;
        }
      }
    }
    return sum;
  }

 private:
  [[nodiscard]] Vec2 uvAt(int face, int corner) const {
    return surface_.cornerUvs(face).at(static_cast<std::size_t>(corner % 4));
  }

  std::vector<TriangleTree::Entry> trianglesOfAll() {
    std::vector<TriangleTree::Entry> entries;
    for (std::size_t face = 0; face < count_; ++face) {
      const int first = static_cast<int>(face) * perFace_;
      std::array<Vec2, 4> corners{};
      for (int k = 0; k < 4; ++k) {
        // A triangle's three faces begin at its corners; the fourth is the third again.
        corners.at(static_cast<std::size_t>(k)) =
            perFace_ == 1 ? uvAt(first, k) : uvAt(first + std::min(k, 2), 0);
      }
      const double twice = cross(corners[2] - corners[0], corners[3] - corners[1]);
      const std::vector<TextureTriangle> triangles = trianglesOf(corners);
      turns_[face] = triangles.empty() ? 0 : (twice > 0 ? 1 : -1);
      for (const TextureTriangle& triangle : triangles) {
        entries.push_back({triangle, boxOf(triangle), face});
      }
    }
    return entries;
  }

  const LimitSurface& surface_;
  int perFace_;
  std::size_t count_;
  std::vector<int> turns_;  ///< 1 counter-clockwise, -1 mirrored, 0 without area
  TriangleTree tree_;
};

/// Of every face the share of its area in the texture that lies under others; none where it lies
/// under none.
std::vector<std::optional<double>> coveredShares(const FacesInTexture& faces) {
  const std::vector<TriangleTree::Entry>& entries = faces.tree().entries();
  std::vector<std::optional<double>> covered(entries.size());
  parallelFor(
      0, entries.size(),
      [&](std::size_t k) {
        const TriangleTree::Entry& entry = entries[k];
        Rest rest(entry.corners);
        const auto isAny = [](const TriangleTree::Entry&) { return true; };
        faces.tree().forEachOver(entry, isAny, [&](const TriangleTree::Entry& other) {
          const bool isMore = rest.takeAway(other.corners);
          covered[k] = rest.taken();
          return isMore;
        });
      },
      64);
  std::vector<double> areas(faces.count());
  std::vector<std::optional<double>> shares(faces.count());
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const auto& [a, b, c] = entries[k].corners;
    areas[entries[k].face] += cross(b - a, c - a) / 2;
    if (!covered[k]) continue;
    std::optional<double>& share = shares[entries[k].face];
    share = share.value_or(0) + *covered[k];
  }
  for (std::size_t face = 0; face < shares.size(); ++face) {
    if (shares[face]) *shares[face] /= areas[face];
  }
  return shares;
}

/// The charts of the cage's faces: each grows from its first face as long as nothing overlaps.
class ChartGrower {
 public:
  ChartGrower(const FacesInTexture& faces, const std::vector<std::optional<double>>& shares)
      : faces_(faces), shares_(shares), next_(faces.continued()), charts_(faces.count(), 0) {
    const auto& entries = faces.tree().entries();
    triangles_.resize(faces.count());
    for (std::size_t k = 0; k < entries.size(); ++k) triangles_[entries[k].face].push_back(k);
  }

  std::vector<int> grow() {
    int chart = 0;
    for (std::size_t first = 0; first < charts_.size(); ++first) {
      if (charts_[first] != 0) continue;
      charts_[first] = ++chart;
      std::vector<std::size_t> ring = {first};
      // In rings about the first face, so that charts are compact.
      while (!ring.empty()) {
        std::vector<std::size_t> outer;
        for (const std::size_t face : ring) {
          for (const std::size_t next : next_[face]) {
            if (charts_[next] != 0 || isOver(next, chart)) continue;
            charts_[next] = chart;
            outer.push_back(next);
          }
        }
        ring = std::move(outer);
      }
    }
    return std::move(charts_);
  }

 private:
  /// Whether a face lies over one of a chart's.
  [[nodiscard]] bool isOver(std::size_t face, int chart) const {
    if (!shares_[face]) return false;
    bool isFound = false;
    for (const std::size_t k : triangles_[face]) {
      faces_.tree().forEachOver(
          faces_.tree().entries()[k],
          [&](const TriangleTree::Entry& other) { return charts_[other.face] == chart; },
          [&](const TriangleTree::Entry&) {
            isFound = true;
            return false;
          });
    }
    return isFound;
  }

  const FacesInTexture& faces_;
  const std::vector<std::optional<double>>& shares_;
  std::vector<std::vector<std::size_t>> next_;
  std::vector<std::vector<std::size_t>> triangles_;
  std::vector<int> charts_;
};

double sharedAreaOf(const FacesInTexture& faces, const std::vector<std::optional<double>>& shares) {
  std::vector<double> areas(faces.count());
  parallelFor(
      0, areas.size(), [&](std::size_t face) { areas[face] = faces.worldArea(face); }, 64);
  double all = 0;
  double shared = 0;
  for (std::size_t face = 0; face < areas.size(); ++face) {
    all += areas[face];
    shared += shares[face].value_or(0) * areas[face];
  }
  return all > 0 ? std::min(shared / all, 1.0) : 0;
}

}  // namespace

int orientation(Vec2 a, Vec2 b, Vec2 c) {
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  if (left == 0 && right == 0) return 0;
  const double twice = left - right;
  constexpr double bound = 3.3306690738754716e-16;  // (3 + 16 ε) ε, ε = 2^-53
  if (std::abs(twice) > bound * (std::abs(left) + std::abs(right))) return twice > 0 ? 1 : -1;
  std::array<double, 12> terms{};
  std::size_t count = 0;
  const auto add = [&](double x, double y) {
    terms.at(count++) = x * y;
    terms.at(count++) = std::fma(x, y, -(x * y));
  };
  add(a.x, b.y);
  add(-a.x, c.y);
  add(-c.x, b.y);
  add(-a.y, b.x);
  add(a.y, c.x);
  add(c.y, b.x);
  return signOfSum(terms);
}

bool isInside(const TextureTriangle& triangle, Vec2 place) {
  const auto& [a, b, c] = triangle;
  return orientation(a, b, place) > 0 && orientation(b, c, place) > 0 &&
         orientation(c, a, place) > 0;
}

std::vector<TextureTriangle> trianglesOf(const std::array<Vec2, 4>& corners) {
  const auto& [a, b, c, d] = corners;
  // Where b or d is a reflex corner the diagonal a to c lies outside.
  const bool isCutAlong = orientation(a, b, c) * orientation(a, c, d) >= 0 ||
                          orientation(b, c, d) * orientation(b, d, a) < 0;
  std::vector<TextureTriangle> triangles;
  const auto add = [&](Vec2 first, Vec2 second, Vec2 third) {
    const int turn = orientation(first, second, third);
    if (turn > 0) triangles.push_back({first, second, third});
    if (turn < 0) triangles.push_back({first, third, second});
  };
  if (isCutAlong) {
    add(a, b, c);
    add(a, c, d);
  } else {
    add(b, c, d);
    add(b, d, a);
  }
  return triangles;
}

TextureLayout textureLayout(const LimitSurface& surface) {
  const FacesInTexture faces(surface);
  const std::vector<std::optional<double>> shares = coveredShares(faces);
  TextureLayout layout;
  const std::vector<int> charts = ChartGrower(faces, shares).grow();
  layout.charts.resize(static_cast<std::size_t>(surface.faceCount()));
  for (int face = 0; face < surface.faceCount(); ++face) {
    layout.charts[static_cast<std::size_t>(face)] = charts[faces.cageFace(face)];
  }
  layout.chartCount = *std::max_element(charts.begin(), charts.end());
  layout.isOneToOne = std::none_of(shares.begin(), shares.end(),
                                   [](const auto& share) { return share.has_value(); });
  if (!layout.isOneToOne) layout.sharedArea = sharedAreaOf(faces, shares);
  return layout;
}

}  // namespace gnomon::surface
