#include "surface/cage/polygon_cage.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "common/error.h"
#include "common/system/memory.h"

namespace gnomon::surface {
namespace {

constexpr int mostPolygonCorners = 4096;  // cutting takes time of the square of their number

/// A triangle or quadrilateral on which everything is linear or bilinear. Its corners are numbered
/// among those of all polygons.
struct Piece {
  std::size_t polygon;
  int size;
  std::array<std::size_t, 4> corners;

  [[nodiscard]] std::size_t corner(int k) const {
    return corners.at(static_cast<std::size_t>(k % size));
  }
};

double turnOf(Vec2 a, Vec2 b) {
  return a.x * b.y - a.y * b.x;
}

/// Twice the area vector (Newell).
Vec3 areaVector(std::span<const Vec3> corners) {
  Vec3 area(0);
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
    area += glm::cross(corners[k] - corners[0], corners[k + 1] - corners[0]);
  }
  return area;
}

/// The corners in the plane of their area vector, counter-clockwise.
std::vector<Vec2> inPlane(std::span<const Vec3> corners) {
  const Vec3 area = areaVector(corners);
  const double length = glm::length(area);
  const Vec3 normal = length > 0 ? area / length : Vec3(0, 0, 1);
  const Vec3 axis = std::abs(normal.x) < 0.5 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  const Vec3 e1 = glm::normalize(glm::cross(axis, normal));
  const Vec3 e2 = glm::cross(normal, e1);
  std::vector<Vec2> flat;
  flat.reserve(corners.size());
  for (const Vec3& corner : corners) {
    flat.emplace_back(glm::dot(corner - corners[0], e1), glm::dot(corner - corners[0], e2));
  }
  return flat;
}

/// Whether the polygon turns outward at `own`, by more than rounding.
bool turnsOutward(Vec2 before, Vec2 own, Vec2 after) {
  const Vec2 in = own - before;
  const Vec2 out = after - own;
  return turnOf(in, out) > 1e-9 * glm::length(in) * glm::length(out);
}

bool isConvexQuadrilateral(std::span<const Vec3> corners) {
  const std::vector<Vec2> flat = inPlane(corners);
  for (std::size_t k = 0; k < 4; ++k) {
    if (!turnsOutward(flat[(k + 3) % 4], flat[k], flat[(k + 1) % 4])) return false;
  }
  return true;
}

/// Cuts corner after corner off one polygon.
class CornerCutter {
 public:
  explicit CornerCutter(std::span<const Vec3> corners)
      : corners_(corners), flat_(inPlane(corners)), left_(corners.size()), isEar_(corners.size()) {
    std::iota(left_.begin(), left_.end(), std::size_t{0});
    for (std::size_t k = 0; k < left_.size(); ++k) isEar_[k] = findEar(k);
  }

  std::vector<std::array<int, 3>> cut() {
    std::vector<std::array<int, 3>> triangles;
    while (left_.size() > 3) {
      const std::size_t k = nextCorner();
      triangles.push_back(triangleAt(k));
      left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(k));
      isEar_.erase(isEar_.begin() + static_cast<std::ptrdiff_t>(k));
      // What is cut off holds no corner, so that the others stay what they are.
      for (const std::size_t changed : {before(k % left_.size()), k % left_.size()}) {
        isEar_[changed] = findEar(changed);
      }
    }
    triangles.push_back(triangleAt(1));
    return triangles;
  }

 private:
  [[nodiscard]] std::size_t before(std::size_t k) const {
    return (k + left_.size() - 1) % left_.size();
  }
  [[nodiscard]] std::size_t after(std::size_t k) const { return (k + 1) % left_.size(); }

  [[nodiscard]] std::array<int, 3> triangleAt(std::size_t k) const {
    return {static_cast<int>(left_[before(k)]), static_cast<int>(left_[k]),
            static_cast<int>(left_[after(k)])};
  }

  [[nodiscard]] bool findEar(std::size_t k) const {
    const Vec2 a = flat_[left_[before(k)]];
    const Vec2 b = flat_[left_[k]];
    const Vec2 c = flat_[left_[after(k)]];
    if (!turnsOutward(a, b, c)) return false;
    // A corner in the very place of one of the triangle's (both ends of a cut to a hole) is no
    // obstacle.
    return std::none_of(left_.begin(), left_.end(), [&](std::size_t other) {
      const Vec2 p = flat_[other];
      return p != a && p != b && p != c && turnOf(b - a, p - a) >= 0 && turnOf(c - b, p - b) >= 0 &&
             turnOf(a - c, p - c) >= 0;
    });
  }

  /// Of all corners, if the polygon crosses itself.
  [[nodiscard]] std::size_t nextCorner() const {
    const bool isAny = std::find(isEar_.begin(), isEar_.end(), true) != isEar_.end();
    std::optional<std::size_t> best;
    double shortest = 0;
    for (std::size_t k = 0; k < left_.size(); ++k) {
      if (isAny && !isEar_[k]) continue;
      const Vec3 diagonal = corners_[left_[after(k)]] - corners_[left_[before(k)]];
      const double square = glm::dot(diagonal, diagonal);
      if (best && !(square < shortest)) continue;
      best = k;
      shortest = square;
    }
    return best.value_or(0);
  }

  std::span<const Vec3> corners_;
  std::vector<Vec2> flat_;
  std::vector<std::size_t> left_;  ///< of the corners
  std::vector<bool> isEar_;        ///< of those left
};

std::vector<Piece> piecesOf(const Polygons& polygons, const PartNames& names) {
  std::vector<Piece> pieces;
  pieces.reserve(polygons.faceSizes.size());
  std::vector<Vec3> corners;
  std::size_t begin = 0;
  for (std::size_t polygon = 0; polygon < polygons.faceSizes.size(); ++polygon) {
    const int size = polygons.faceSizes[polygon];
    if (size > mostPolygonCorners) {
      throw InputError(fmt::format("{} has {} corners, expected 3 to {}", names.face(polygon), size,
                                   mostPolygonCorners));
    }
    corners.clear();
    for (std::size_t k = begin; k < begin + static_cast<std::size_t>(size); ++k) {
      corners.push_back(polygons.positions[static_cast<std::size_t>(polygons.faceVertices[k])]);
    }
    if (size == 3) {
      pieces.push_back({polygon, 3, {begin, begin + 1, begin + 2, 0}});
    } else if (size == 4 && isConvexQuadrilateral(corners)) {
      pieces.push_back({polygon, 4, {begin, begin + 1, begin + 2, begin + 3}});
    } else {
      for (const auto& [a, b, c] : cutIntoTriangles(corners)) {
        const auto at = [begin](int k) { return begin + static_cast<std::size_t>(k); };
        pieces.push_back({polygon, 3, {at(a), at(b), at(c), 0}});
      }
    }
    begin += static_cast<std::size_t>(size);
  }
  return pieces;
}

/// A vector of length 1; zero for one that is too short to have a direction.
Vec3 unitOrZero(const Vec3& vector, double least = 0) {
  const double length = glm::length(vector);
  return length > least && std::isfinite(length) ? vector / length : Vec3(0);
}

/// Both kinds of normals.
struct Normals {
  std::vector<Vec3> ofCorners;     ///< of shading, at the corners of all polygons
  std::vector<Vec3> ofDirections;  ///< at all vertices
};

class NormalMaker {
 public:
  NormalMaker(const Polygons& polygons, const std::vector<Piece>& pieces)
      : polygons_(polygons), pieces_(pieces), place_(firstInPlace(polygons.positions)) {}

  Normals make(const PartNames& names) const {
    const std::vector<Vec3> smooth =
        meansAtPlaces([](std::size_t, const Vec3& ofPiece) { return ofPiece; });
    Normals normals;
    normals.ofCorners.resize(polygons_.faceVertices.size());
    for (std::size_t corner = 0; corner < normals.ofCorners.size(); ++corner) {
      const Vec3 own = ownNormal(corner, names);
      normals.ofCorners[corner] = own == Vec3(0) ? smooth[placeOf(corner)] : own;
    }
    normals.ofDirections =
        meansAtPlaces([&](std::size_t corner, const Vec3&) { return normals.ofCorners[corner]; });
    // Normals of shading that cancel each other leave the polygons'.
    for (std::size_t place = 0; place < smooth.size(); ++place) {
      Vec3& direction = normals.ofDirections[place];
      if (direction == Vec3(0)) direction = smooth[place];
    }
    for (std::size_t vertex = 0; vertex < place_.size(); ++vertex) {
      normals.ofDirections[vertex] = normals.ofDirections[static_cast<std::size_t>(place_[vertex])];
    }
    return normals;
  }

 private:
  [[nodiscard]] std::size_t vertexOf(std::size_t corner) const {
    return static_cast<std::size_t>(polygons_.faceVertices[corner]);
  }
  [[nodiscard]] std::size_t placeOf(std::size_t corner) const {
    return static_cast<std::size_t>(place_[vertexOf(corner)]);
  }

  /// Of the file; zero where there is none.
  [[nodiscard]] Vec3 ownNormal(std::size_t corner, const PartNames& names) const {
    if (polygons_.faceNormals.empty() || polygons_.faceNormals[corner] < 0) return Vec3(0);
    const auto index = static_cast<std::size_t>(polygons_.faceNormals[corner]);
    if (index >= polygons_.normals.size()) {
      throw InputError(fmt::format("{}: a face refers to normal {}, but there are {}", names.source,
                                   index + static_cast<std::size_t>(names.firstFace),
                                   polygons_.normals.size()));
    }
    return unitOrZero(polygons_.normals[index]);
  }

  /// For each vertex that is the first in its place the mean of what all corners there have,
  /// weighted by their angles.
  /// @param valueOf  of a corner, and the piece's normal there
  template <typename ValueOf>
  [[nodiscard]] std::vector<Vec3> meansAtPlaces(const ValueOf& valueOf) const {
    std::vector<Vec3> sums(polygons_.positions.size(), Vec3(0));
    std::vector<double> angles(polygons_.positions.size(), 0);
    for (const Piece& piece : pieces_) {
      for (int k = 0; k < piece.size; ++k) {
        const auto position = [&](int corner) {
          return polygons_.positions[vertexOf(piece.corner(corner))];
        };
        const Vec3 next = position(k + 1) - position(k);
        const Vec3 previous = position(k + piece.size - 1) - position(k);
        const Vec3 area = glm::cross(next, previous);
        const double angle = std::atan2(glm::length(area), glm::dot(next, previous));
        const std::size_t corner = piece.corner(k);
        sums[placeOf(corner)] += angle * valueOf(corner, unitOrZero(area));
        angles[placeOf(corner)] += angle;
      }
    }
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] = unitOrZero(sums[i], 1e-9 * angles[i]);
    return sums;
  }

  const Polygons& polygons_;
  const std::vector<Piece>& pieces_;
  std::vector<int> place_;
};

/// The edges of all pieces, by their vertices, the lower first.
class Edges {
 public:
  Edges(const Polygons& polygons, const std::vector<Piece>& pieces) {
    for (const Piece& piece : pieces) {
      for (int k = 0; k < piece.size; ++k) {
        edges_.emplace_back(std::minmax(polygons.faceVertices[piece.corner(k)],
                                        polygons.faceVertices[piece.corner(k + 1)]));
      }
    }
    std::sort(edges_.begin(), edges_.end());
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
  }

  [[nodiscard]] const std::vector<std::pair<int, int>>& all() const { return edges_; }
  [[nodiscard]] int indexOf(int a, int b) const {
    const std::pair<int, int> edge = std::minmax(a, b);
    return static_cast<int>(std::lower_bound(edges_.begin(), edges_.end(), edge) - edges_.begin());
  }

 private:
  std::vector<std::pair<int, int>> edges_;
};

/// Adds faces to a cage.
class CageBuilder {
 public:
  CageBuilder(Cage& cage, const Polygons& polygons, const Normals& normals,
              const std::vector<Piece>& pieces)
      : cage_(cage), polygons_(polygons), normals_(normals), pieces_(pieces) {
    cage_.positions.assign(polygons.positions.begin(), polygons.positions.end());
    cage_.directions = normals.ofDirections;
  }

  /// Each is one face.
  void addQuadrilaterals() {
    for (const Piece& piece : pieces_) {
      const std::array<int, 4> vertices = {vertexOf(piece, 0), vertexOf(piece, 1),
                                           vertexOf(piece, 2), vertexOf(piece, 3)};
      const int first = addCorners(piece);
      addFace(vertices, {first, first + 1, first + 2, first + 3});
    }
  }

  /// Each is one face a corner: the corner, the middle of the side that leaves it, the middle of
  /// all, and the middle of the side that comes to it.
  void addCornerByCorner() {
    const Edges edges(polygons_, pieces_);
    const auto firstMiddle = static_cast<int>(cage_.positions.size());
    for (const auto& [a, b] : edges.all()) addVertex({a, b});
    for (const Piece& piece : pieces_) {
      const int centre = addCentre(piece);
      const int first = addCorners(piece);
      const int firstSide = first + piece.size;
      for (int k = 0; k < piece.size; ++k) addMean({first + k, first + (k + 1) % piece.size});
      const int middle = addMiddle(piece, first);
      for (int k = 0; k < piece.size; ++k) {
        const int previous = (k + piece.size - 1) % piece.size;
        const auto side = [&](int from) {
          return firstMiddle + edges.indexOf(vertexOf(piece, from), vertexOf(piece, from + 1));
        };
        addFace({vertexOf(piece, k), side(k), centre, side(previous)},
                {first + k, firstSide + k, middle, firstSide + previous});
      }
    }
  }

 private:
  [[nodiscard]] int vertexOf(const Piece& piece, int k) const {
    return polygons_.faceVertices[piece.corner(k)];
  }

  /// In the middle of vertices.
  int addVertex(const std::vector<int>& of) {
    Vec3 position(0), direction(0);
    for (const int vertex : of) {
      position += cage_.positions[static_cast<std::size_t>(vertex)];
      direction += cage_.directions[static_cast<std::size_t>(vertex)];
    }
    cage_.positions.push_back(position / static_cast<double>(of.size()));
    cage_.directions.push_back(direction / static_cast<double>(of.size()));
    return static_cast<int>(cage_.positions.size()) - 1;
  }
  int addCentre(const Piece& piece) {
    std::vector<int> vertices;
    vertices.reserve(static_cast<std::size_t>(piece.size));
    for (int k = 0; k < piece.size; ++k) vertices.push_back(vertexOf(piece, k));
    return addVertex(vertices);
  }

  /// Texture coordinates and normals, which have the same numbers.
  /// @return the first
  int addCorners(const Piece& piece) {
    const auto first = static_cast<int>(cage_.uvs.size());
    for (int k = 0; k < piece.size; ++k) {
      const std::size_t corner = piece.corner(k);
      cage_.uvs.push_back(polygons_.uvs[static_cast<std::size_t>(polygons_.faceUvs[corner])]);
      cage_.normals.push_back(normals_.ofCorners[corner]);
    }
    return first;
  }
  int addMean(const std::vector<int>& of) {
    Vec2 uv(0);
    Vec3 normal(0);
    for (const int corner : of) {
      uv += cage_.uvs[static_cast<std::size_t>(corner)];
      normal += cage_.normals[static_cast<std::size_t>(corner)];
    }
    cage_.uvs.push_back(uv / static_cast<double>(of.size()));
    cage_.normals.push_back(normal / static_cast<double>(of.size()));
    return static_cast<int>(cage_.uvs.size()) - 1;
  }
  int addMiddle(const Piece& piece, int first) {
    std::vector<int> corners(static_cast<std::size_t>(piece.size));
    std::iota(corners.begin(), corners.end(), first);
    return addMean(corners);
  }

  void addFace(const std::array<int, 4>& vertices, const std::array<int, 4>& corners) {
    cage_.faceVertices.insert(cage_.faceVertices.end(), vertices.begin(), vertices.end());
    cage_.faceUvs.insert(cage_.faceUvs.end(), corners.begin(), corners.end());
    cage_.faceNormals.insert(cage_.faceNormals.end(), corners.begin(), corners.end());
  }

  Cage& cage_;
  const Polygons& polygons_;
  const Normals& normals_;
  const std::vector<Piece>& pieces_;
};

void requireNormals(const Polygons& polygons, const PartNames& names) {
  for (std::size_t i = 0; i < polygons.normals.size(); ++i) {
    const Vec3& n = polygons.normals[i];
    if (std::isfinite(n.x) && std::isfinite(n.y) && std::isfinite(n.z)) continue;
    throw InputError(fmt::format("{}: normal {} is ({:g}, {:g}, {:g}), expected finite numbers",
                                 names.source, i + static_cast<std::size_t>(names.firstFace), n.x,
                                 n.y, n.z));
  }
}

}  // namespace

std::vector<int> firstInPlace(std::span<const Vec3> positions) {
  const auto place = [positions](int vertex) {
    const Vec3& p = positions[static_cast<std::size_t>(vertex)];
    return std::tie(p.x, p.y, p.z);
  };
  std::vector<int> order(positions.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&place](int a, int b) {
    return std::tuple_cat(place(a), std::tie(a)) < std::tuple_cat(place(b), std::tie(b));
  });
  std::vector<int> first(positions.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto vertex = static_cast<std::size_t>(order[i]);
    const bool same = i > 0 && place(order[i - 1]) == place(order[i]);
    first[vertex] = same ? first[static_cast<std::size_t>(order[i - 1])] : order[i];
  }
  return first;
}

std::vector<std::array<int, 3>> cutIntoTriangles(std::span<const Vec3> corners) {
  return CornerCutter(corners).cut();
}

Cage makePolygonCage(const Polygons& polygons, const PartNames& names,
                     std::span<const int> faceParts) {
  requirePolygons(polygons, names);
  requireNormals(polygons, names);
  constexpr double bytesPerCorner = 600;
  requireMemory(
      bytesPerCorner * static_cast<double>(polygons.faceVertices.size()),
      fmt::format("{}: polygons of {} corners", names.source, polygons.faceVertices.size()));
  const std::vector<Piece> pieces = piecesOf(polygons, names);
  const auto isTriangle = [](const Piece& piece) { return piece.size == 3; };
  const bool areTriangles = std::all_of(pieces.begin(), pieces.end(), isTriangle);
  const bool areQuadrilaterals = std::none_of(pieces.begin(), pieces.end(), isTriangle);
  const Normals normals = NormalMaker(polygons, pieces).make(names);
  Cage cage;
  cage.scheme = SubdivisionScheme::none;
  cage.facesPerPolygon = areTriangles ? 3 : 1;
  CageBuilder builder(cage, polygons, normals, pieces);
  if (areQuadrilaterals) {
    builder.addQuadrilaterals();
  } else {
    builder.addCornerByCorner();
  }
  if (!faceParts.empty()) {
    for (const Piece& piece : pieces) {
      const std::size_t faces = areQuadrilaterals ? 1 : static_cast<std::size_t>(piece.size);
      cage.faceParts.insert(cage.faceParts.end(), faces, faceParts[piece.polygon]);
    }
  }
  return cage;
}

}  // namespace gnomon::surface
