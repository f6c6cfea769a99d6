#include "surface/readers/polygon_mesh.h"

#include <fmt/format.h>
#include <opensubdiv/far/primvarRefiner.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <tuple>
#include <utility>

#include "common/error.h"
#include "surface/cage/polygon_cage.h"

namespace gnomon::surface {

namespace {

namespace Far = OpenSubdiv::Far;

/// One point of the texture for all corners that have none: no area, and so no frame.
void giveMissingUvs(PolygonMesh& mesh) {
  const auto missing = std::count(mesh.faceUvs.begin(), mesh.faceUvs.end(), noUv);
  if (missing == 0) return;
  if (static_cast<std::size_t>(missing) == mesh.faceUvs.size()) {
    throw InputError(fmt::format(
        "{}: no face has texture coordinates: unwrap the mesh and export it with its UVs",
        mesh.names.source));
  }
  std::replace(mesh.faceUvs.begin(), mesh.faceUvs.end(), noUv, static_cast<int>(mesh.uvs.size()));
  mesh.uvs.emplace_back(0, 0);
}

/// Joins the vertices of a mesh edge by edge.
class VertexJoiner {
 public:
  explicit VertexJoiner(PolygonMesh& mesh)
      : mesh_(mesh), place_(firstInPlace(mesh.positions)), joined_(mesh.positions.size()) {
    std::iota(joined_.begin(), joined_.end(), 0);
  }

  JoinedVertices join() {
    const auto count = static_cast<int>(mesh_.positions.size());
    const auto isNone = [count](int vertex) { return vertex < 0 || vertex >= count; };
    const bool isAnyTwice = !std::equal(place_.begin(), place_.end(), joined_.begin());
    // An index that there is none of is for `makeTopologyRefiner` to refuse.
    if (!isAnyTwice || std::any_of(mesh_.faceVertices.begin(), mesh_.faceVertices.end(), isNone)) {
      return {};
    }
    gatherEdges();
    JoinedVertices result;
    // Once two edges are one, others that met theirs at an end may be too.
    for (bool isMore = true; isMore;) std::tie(result.apartEdges, isMore) = joinEdges();
    std::vector<bool> isGone(mesh_.positions.size());
    for (int& vertex : mesh_.faceVertices) rename(vertex, isGone);
    result.vertices = static_cast<int>(std::count(isGone.begin(), isGone.end(), true));
    for (Crease& crease : mesh_.creases) {
      for (int& vertex : crease.vertices) rename(vertex, isGone);
    }
    for (SharpVertex& sharp : mesh_.sharpVertices) rename(sharp.vertex, isGone);
    return result;
  }

 private:
  /// One face's side.
  struct Edge {
    int from, to;
  };

  [[nodiscard]] int placeOf(int vertex) const { return place_[static_cast<std::size_t>(vertex)]; }
  [[nodiscard]] std::pair<int, int> placesOf(const Edge& edge) const {
    return std::minmax(placeOf(edge.from), placeOf(edge.to));
  }

  void gatherEdges() {
    std::size_t begin = 0;
    for (const int faceSize : mesh_.faceSizes) {
      const auto size = static_cast<std::size_t>(faceSize);
      for (std::size_t corner = 0; corner < size; ++corner) {
        const Edge edge{mesh_.faceVertices[begin + corner],
                        mesh_.faceVertices[begin + (corner + 1) % size]};
        if (placeOf(edge.from) != placeOf(edge.to)) edges_.push_back(edge);
      }
      begin += size;
    }
    std::stable_sort(edges_.begin(), edges_.end(),
                     [this](const Edge& a, const Edge& b) { return placesOf(a) < placesOf(b); });
  }

  /// @return how many places stay where edges lie that are not joined, and whether any were
  std::pair<int, bool> joinEdges() {
    int apart = 0;
    bool isAny = false;
    for (std::size_t begin = 0, end = 0; begin < edges_.size(); begin = end) {
      while (end < edges_.size() && placesOf(edges_[end]) == placesOf(edges_[begin])) ++end;
      const std::size_t count = end - begin;
      if (count == 1) continue;
      // A body has no more faces about an edge than about a vertex.
      if (count > std::size_t{mostVertexFaces}) {
        ++apart;
        continue;
      }
      const std::vector<Edge> open = openEdges(std::span(edges_).subspan(begin, count));
      if (open.size() < 2) continue;
      const bool areOne = open.size() == 2 && placeOf(open[0].from) == placeOf(open[1].to);
      if (areOne) {
        unite(open[0].from, open[1].to);
        unite(open[0].to, open[1].from);
        isAny = true;
      } else {
        ++apart;
      }
    }
    return {apart, isAny};
  }

  /// Those of one place that share their vertices with no other.
  std::vector<Edge> openEdges(std::span<const Edge> edges) {
    std::vector<Edge> open;
    for (const Edge& edge : edges) {
      const Edge found{root(edge.from), root(edge.to)};
      const auto isSame = [&found](const Edge& other) {
        return std::minmax(found.from, found.to) == std::minmax(other.from, other.to);
      };
      const auto other = std::find_if(open.begin(), open.end(), isSame);
      if (other == open.end()) {
        open.push_back(found);
      } else {
        open.erase(other);
      }
    }
    return open;
  }

  int root(int vertex) {
    while (joined_[static_cast<std::size_t>(vertex)] != vertex) {
      int& above = joined_[static_cast<std::size_t>(vertex)];
      above = joined_[static_cast<std::size_t>(above)];
      vertex = above;
    }
    return vertex;
  }

  void unite(int a, int b) {
    const auto [first, second] = std::minmax({root(a), root(b)});
    joined_[static_cast<std::size_t>(second)] = first;
  }

  /// @param isGone  of vertices that another stands for
  void rename(int& vertex, std::vector<bool>& isGone) {
    // A tag's vertex that there is none of is for `makeTopologyRefiner` to refuse.
    if (vertex < 0 || static_cast<std::size_t>(vertex) >= joined_.size()) return;
    const int first = root(vertex);
    if (first != vertex) isGone[static_cast<std::size_t>(vertex)] = true;
    vertex = first;
  }

  PolygonMesh& mesh_;
  std::vector<int> place_;   ///< of each vertex: the first vertex there
  std::vector<int> joined_;  ///< of each vertex: one that it is joined to, the first last
  std::vector<Edge> edges_;  ///< by their places
};

/// What the faces' parts are called, and the part of each.
struct Parts {
  std::vector<std::string> names;
  std::vector<int> ofFaces;
};

Parts partsOf(const std::vector<std::string>& faceNames) {
  Parts parts;
  for (const std::string& name : faceNames) {
    const auto found = std::find(parts.names.begin(), parts.names.end(), name);
    parts.ofFaces.push_back(static_cast<int>(found - parts.names.begin()));
    if (found == parts.names.end()) parts.names.push_back(name);
    if (parts.names.size() > mostParts) return {};
  }
  return parts.names.size() < 2 ? Parts() : parts;
}

Polygons polygonsOf(const PolygonMesh& mesh, SubdivisionScheme scheme) {
  return {.positions = mesh.positions,
          .faceSizes = mesh.faceSizes,
          .faceVertices = mesh.faceVertices,
          .uvs = mesh.uvs,
          .faceUvs = mesh.faceUvs,
          .creases = mesh.creases,
          .sharpVertices = mesh.sharpVertices,
          .border = CageBorder::edgesAndCorners,
          .scheme = scheme,
          .normals = mesh.normals,
          .faceNormals = mesh.faceNormals};
}

/// A vector as OpenSubdiv's refiner wants to add it up.
template <typename Vector>
struct Weighted {
  Vector value{0};
  void Clear() { value = Vector(0); }
  void AddWithWeight(const Weighted& source, double weight) { value += weight * source.value; }
};

template <typename Vector>
std::vector<Weighted<Vector>> weighted(const std::vector<Vector>& values) {
  std::vector<Weighted<Vector>> result;
  result.reserve(values.size());
  for (const Vector& value : values) result.push_back({value});
  return result;
}

template <typename Vector>
std::vector<Vector> plain(const std::vector<Weighted<Vector>>& values) {
  std::vector<Vector> result;
  result.reserve(values.size());
  for (const Weighted<Vector>& value : values) result.push_back(value.value);
  return result;
}

/// What is left of creases and sharp vertices after one step. Borders are sharp by rule.
void takeSharpness(const Far::TopologyLevel& level, Cage& cage) {
  for (int edge = 0; edge < level.GetNumEdges(); ++edge) {
    const double sharpness = level.GetEdgeSharpness(edge);
    if (sharpness <= 0 || level.IsEdgeBoundary(edge)) continue;
    const auto ends = level.GetEdgeVertices(edge);
    cage.creases.push_back({{ends[0], ends[1]}, sharpness});
  }
  for (int vertex = 0; vertex < level.GetNumVertices(); ++vertex) {
    const double sharpness = level.GetVertexSharpness(vertex);
    if (sharpness <= 0 || level.IsVertexCorner(vertex)) continue;
    cage.sharpVertices.push_back({vertex, sharpness});
  }
}

/// One step of Catmull-Clark: every n-gon becomes n quadrilaterals. Texture coordinates are halved
/// linearly, so that a quadrilateral's bilinear map stays what it was.
Cage refine(const PolygonMesh& mesh, const std::vector<int>& faceParts,
            Far::TopologyRefiner& refiner) {
  Far::TopologyRefiner::UniformOptions options(1);
  options.fullTopologyInLastLevel = true;
  refiner.RefineUniform(options);
  const Far::TopologyLevel level = refiner.GetLevel(1);
  const Far::PrimvarRefinerReal<double> interpolator(refiner);

  std::vector<Weighted<Vec3>> positions(static_cast<std::size_t>(level.GetNumVertices()));
  interpolator.Interpolate(1, weighted(mesh.positions), positions);
  std::vector<Weighted<Vec2>> uvs(static_cast<std::size_t>(level.GetNumFVarValues(0)));
  interpolator.InterpolateFaceVarying(1, weighted(mesh.uvs), uvs, 0);

  Cage cage;
  cage.positions = plain(positions);
  cage.uvs = plain(uvs);
  for (int face = 0; face < level.GetNumFaces(); ++face) {
    const auto vertices = level.GetFaceVertices(face);
    const auto faceUvs = level.GetFaceFVarValues(face, 0);
    cage.faceVertices.insert(cage.faceVertices.end(), vertices.begin(), vertices.end());
    cage.faceUvs.insert(cage.faceUvs.end(), faceUvs.begin(), faceUvs.end());
    if (faceParts.empty()) continue;
    const auto parent = static_cast<std::size_t>(level.GetFaceParentFace(face));
    cage.faceParts.push_back(faceParts[parent]);
  }
  takeSharpness(level, cage);
  return cage;
}

Cage unrefined(PolygonMesh mesh, std::vector<int> faceParts, SubdivisionScheme scheme) {
  Cage cage;
  cage.scheme = scheme;
  cage.positions = std::move(mesh.positions);
  cage.faceVertices = std::move(mesh.faceVertices);
  cage.uvs = std::move(mesh.uvs);
  cage.faceUvs = std::move(mesh.faceUvs);
  cage.creases = std::move(mesh.creases);
  cage.sharpVertices = std::move(mesh.sharpVertices);
  cage.faceParts = std::move(faceParts);
  return cage;
}

}  // namespace

Cage toCage(PolygonMesh mesh, SubdivisionScheme scheme) {
  giveMissingUvs(mesh);
  const bool loop = scheme == SubdivisionScheme::loop;
  const auto odd = std::find_if(mesh.faceSizes.begin(), mesh.faceSizes.end(),
                                [loop](int size) { return size != (loop ? 3 : 4); });
  const bool even = odd == mesh.faceSizes.end();
  if (loop && !even) {
    const auto face = static_cast<std::size_t>(odd - mesh.faceSizes.begin());
    throw InputError(fmt::format("{} has {} corners, but Loop's scheme takes triangles only",
                                 mesh.names.face(face), *odd));
  }
  const JoinedVertices joined = VertexJoiner(mesh).join();
  Parts parts = partsOf(mesh.faceNames);
  if (scheme == SubdivisionScheme::none) {
    Cage cage = makePolygonCage(polygonsOf(mesh, scheme), mesh.names, parts.ofFaces);
    cage.partNames = std::move(parts.names);
    cage.joined = joined;
    return cage;
  }
  const auto refiner = makeTopologyRefiner(polygonsOf(mesh, scheme), mesh.names, true);
  Cage cage = even ? unrefined(std::move(mesh), std::move(parts.ofFaces), scheme)
                   : refine(mesh, parts.ofFaces, *refiner);
  cage.partNames = std::move(parts.names);
  cage.joined = joined;
  return cage;
}

void TextLine::fail(const std::string& message) const {
  throw InputError(fmt::format("{}:{}: {}", source, number, message));
}

std::optional<TextLine> TextLines::next() {
  if (rest_.empty()) return std::nullopt;
  TextLine line{source_, next_++, {}};
  const std::size_t length = std::min(rest_.find_first_of("\r\n"), rest_.size());
  const std::string_view text = rest_.substr(0, length);
  rest_.remove_prefix(length);
  if (rest_.starts_with("\r\n")) rest_.remove_prefix(1);
  if (!rest_.empty()) rest_.remove_prefix(1);

  constexpr std::string_view blanks = " \t";
  for (std::size_t begin = text.find_first_not_of(blanks); begin != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(blanks, begin), text.size());
    line.tokens.push_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(blanks, end);
  }
  return line;
}

std::string quote(std::string_view token) {
  std::string text(token.substr(0, 40));
  for (char& c : text) {
    if (c < ' ' || c > '~') c = '?';
  }
  return fmt::format("'{}'{}", text, token.size() > text.size() ? "…" : "");
}

int parseInteger(const TextLine& line, std::string_view token, std::string_view what) {
  const auto value = parseNumber<int>(token);
  if (!value) line.fail(fmt::format("{} is {}, expected an integer", what, quote(token)));
  return *value;
}

double parseFinite(const TextLine& line, std::string_view token, std::string_view what) {
  const auto value = parseNumber<double>(token);
  if (!value || !std::isfinite(*value)) {
    line.fail(fmt::format("{} is {}, expected a finite number", what, quote(token)));
  }
  return *value;
}

}  // namespace gnomon::surface
