#include "surface/cage/cage.h"

#include <fmt/format.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/error.h"

namespace gnomon::surface {

std::vector<int> Cage::limitFaceParts() const {
  const std::size_t each = scheme == SubdivisionScheme::loop ? 3 : 1;
  std::vector<int> parts;
  parts.reserve(each * faceParts.size());
  for (const int part : faceParts) parts.insert(parts.end(), each, part);
  return parts;
}

namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;
using RefinerFactory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;

/// Beyond it, products of derivatives would leave the range of double (and GPU floats be coarse).
constexpr double largestCoordinate = 1e12;

std::string part(const PartNames& names, const std::vector<int>& lines, std::size_t index,
                 std::string_view what) {
  const std::string place =
      index < lines.size() ? fmt::format("{}:{}", names.source, lines[index]) : names.source;
  return fmt::format("{}: {}", place, what);
}

void requireSizes(const Polygons& polygons, const PartNames& names) {
  std::size_t corners = 0;
  for (std::size_t face = 0; face < polygons.faceSizes.size(); ++face) {
    const int size = polygons.faceSizes[face];
    if (size < 3 || size > Far::VALENCE_LIMIT) {
      throw InputError(fmt::format("{} has {} corners, expected 3 to {}", names.face(face), size,
                                   Far::VALENCE_LIMIT));
    }
    corners += static_cast<std::size_t>(size);
  }
  if (corners == 0) throw InputError(fmt::format("{}: no faces", names.source));
  if (corners != polygons.faceVertices.size() || corners != polygons.faceUvs.size()) {
    throw InputError(fmt::format("{}: {} face corners, but {} vertex and {} uv indices",
                                 names.source, corners, polygons.faceVertices.size(),
                                 polygons.faceUvs.size()));
  }
  constexpr std::size_t most = std::numeric_limits<int>::max() / 8;
  if (corners > most || polygons.positions.size() > most || polygons.uvs.size() > most) {
    throw InputError(fmt::format("{}: {} face corners and {} vertices, expected at most {}",
                                 names.source, corners, polygons.positions.size(), most));
  }
}

template <typename Vector>
void requireCoordinates(std::span<const Vector> values, std::string_view what,
                        const PartNames& names) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    for (int axis = 0; axis < Vector::length(); ++axis) {
      const double value = values[i][axis];
      if (!(std::abs(value) <= largestCoordinate)) {
        throw InputError(fmt::format("{}: {} {}: coordinate {} is {:g}, expected -{:g} to {:g}",
                                     names.source, what,
                                     i + static_cast<std::size_t>(names.firstFace), axis + 1, value,
                                     largestCoordinate, largestCoordinate));
      }
    }
  }
}

void requireIndex(int index, std::size_t count, const std::string& face, std::string_view what,
                  int first) {
  if (index >= 0 && static_cast<std::size_t>(index) < count) return;
  if (count == 0)
    throw InputError(fmt::format("{} refers to a {}, but there are none", face, what));
  throw InputError(fmt::format("{} refers to {} {}, expected {} to {}", face, what,
                               static_cast<long long>(index) + first, first,
                               count - 1 + static_cast<std::size_t>(first)));
}

void requireFace(const Polygons& polygons, std::size_t face, std::size_t begin,
                 const PartNames& names) {
  const auto size = static_cast<std::size_t>(polygons.faceSizes[face]);
  const auto vertices = polygons.faceVertices.subspan(begin, size);
  const auto uvs = polygons.faceUvs.subspan(begin, size);
  for (std::size_t corner = 0; corner < size; ++corner) {
    const int vertex = vertices[corner];
    if (vertex < 0 || static_cast<std::size_t>(vertex) >= polygons.positions.size()) {
      requireIndex(vertex, polygons.positions.size(), names.face(face), "vertex", names.firstFace);
    }
    if (uvs[corner] < 0 || static_cast<std::size_t>(uvs[corner]) >= polygons.uvs.size()) {
      requireIndex(uvs[corner], polygons.uvs.size(), names.face(face), "texture coordinate",
                   names.firstFace);
    }
    const auto rest = vertices.subspan(corner + 1);
    if (std::find(rest.begin(), rest.end(), vertex) != rest.end()) {
      throw InputError(fmt::format("{} has vertex {} twice, expected different vertices",
                                   names.face(face), vertex + names.firstFace));
    }
  }
}

void requireSharpness(double sharpness, const std::string& name) {
  if (!(sharpness >= 0) || !std::isfinite(sharpness)) {
    throw InputError(
        fmt::format("{} has sharpness {:g}, expected 0 (smooth) to 10 (sharp)", name, sharpness));
  }
}

void requireManifold(const Far::TopologyLevel& level, const PartNames& names) {
  for (int edge = 0; edge < level.GetNumEdges(); ++edge) {
    if (!level.IsEdgeNonManifold(edge)) continue;
    const auto ends = level.GetEdgeVertices(edge);
    const auto faces = level.GetEdgeFaces(edge);
    throw InputError(fmt::format(
        "{} shares the edge of vertices {} and {} with {} other faces or runs along it in the same "
        "direction as another, expected at most two faces that run in opposite directions",
        names.face(static_cast<std::size_t>(faces[faces.size() - 1])), ends[0] + names.firstFace,
        ends[1] + names.firstFace, faces.size() - 1));
  }
  for (int vertex = 0; vertex < level.GetNumVertices(); ++vertex) {
    const auto faces = level.GetVertexFaces(vertex);
    if (faces.size() > mostVertexFaces) {
      throw InputError(fmt::format("{}: vertex {} has {} faces, expected at most {}",
                                   names.face(static_cast<std::size_t>(faces[0])),
                                   vertex + names.firstFace, faces.size(), mostVertexFaces));
    }
    if (faces.empty() || !level.IsVertexNonManifold(vertex)) continue;
    throw InputError(fmt::format(
        "{}: the {} faces about vertex {} form more than one fan, expected "
        "one (split the vertex)",
        names.face(static_cast<std::size_t>(faces[0])), faces.size(), vertex + names.firstFace));
  }
}

/// Sharp edges and vertices as OpenSubdiv takes them.
struct Sharpness {
  std::vector<int> edgeVertices;
  std::vector<float> edges;
  std::vector<int> vertices;
  std::vector<float> corners;
};

Sharpness gatherSharpness(const Polygons& polygons, const PartNames& names) {
  Sharpness sharpness;
  const auto count = polygons.positions.size();
  for (std::size_t i = 0; i < polygons.creases.size(); ++i) {
    const Crease& crease = polygons.creases[i];
    requireSharpness(crease.sharpness, names.crease(i));
    for (const int vertex : crease.vertices) {
      requireIndex(vertex, count, names.crease(i), "vertex", 0);
      sharpness.edgeVertices.push_back(vertex);
    }
    sharpness.edges.push_back(static_cast<float>(std::min(crease.sharpness, 10.0)));
  }
  for (std::size_t i = 0; i < polygons.sharpVertices.size(); ++i) {
    const SharpVertex& vertex = polygons.sharpVertices[i];
    requireSharpness(vertex.sharpness, names.sharpVertex(i));
    requireIndex(vertex.vertex, count, names.sharpVertex(i), "vertex", 0);
    sharpness.vertices.push_back(vertex.vertex);
    sharpness.corners.push_back(static_cast<float>(std::min(vertex.sharpness, 10.0)));
  }
  return sharpness;
}

/// OpenSubdiv only warns about a crease that is no edge.
void requireCreaseEdges(const Polygons& polygons, const PartNames& names) {
  if (polygons.creases.empty()) return;
  std::vector<std::pair<int, int>> edges;
  edges.reserve(polygons.faceVertices.size());
  std::size_t begin = 0;
  for (const int faceSize : polygons.faceSizes) {
    const auto size = static_cast<std::size_t>(faceSize);
    for (std::size_t corner = 0; corner < size; ++corner) {
      edges.push_back(std::minmax(polygons.faceVertices[begin + corner],
                                  polygons.faceVertices[begin + (corner + 1) % size]));
    }
    begin += size;
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0; i < polygons.creases.size(); ++i) {
    const auto [a, b] = polygons.creases[i].vertices;
    const std::pair<int, int> edge = std::minmax(a, b);
    if (!std::binary_search(edges.begin(), edges.end(), edge)) {
      throw InputError(
          fmt::format("{} joins vertices {} and {} (counted from 0), which share no "
                      "edge",
                      names.crease(i), a, b));
    }
  }
}

Sdc::Options schemeOptions(CageBorder border) {
  Sdc::Options options;
  options.SetVtxBoundaryInterpolation(border == CageBorder::support
                                          ? Sdc::Options::VTX_BOUNDARY_NONE
                                          : Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
  options.SetFVarLinearInterpolation(Sdc::Options::FVAR_LINEAR_ALL);
  return options;
}

}  // namespace

std::string PartNames::face(std::size_t index) const {
  return part(*this, faceLines, index,
              fmt::format("face {}", index + static_cast<std::size_t>(firstFace)));
}

std::string PartNames::crease(std::size_t index) const {
  return part(*this, creaseLines, index, "crease");
}

std::string PartNames::sharpVertex(std::size_t index) const {
  return part(*this, sharpVertexLines, index, "corner");
}

void requirePolygons(const Polygons& polygons, const PartNames& names) {
  requireSizes(polygons, names);
  requireCoordinates(polygons.positions, "vertex", names);
  requireCoordinates(polygons.uvs, "texture coordinate", names);
  std::size_t begin = 0;
  for (std::size_t face = 0; face < polygons.faceSizes.size(); ++face) {
    requireFace(polygons, face, begin, names);
    begin += static_cast<std::size_t>(polygons.faceSizes[face]);
  }
}

std::unique_ptr<Far::TopologyRefiner> makeTopologyRefiner(const Polygons& polygons,
                                                          const PartNames& names, bool withUvs) {
  requirePolygons(polygons, names);
  const Sharpness sharpness = gatherSharpness(polygons, names);
  requireCreaseEdges(polygons, names);

  Far::TopologyDescriptor descriptor;
  descriptor.numVertices = static_cast<int>(polygons.positions.size());
  descriptor.numFaces = static_cast<int>(polygons.faceSizes.size());
  descriptor.numVertsPerFace = polygons.faceSizes.data();
  descriptor.vertIndicesPerFace = polygons.faceVertices.data();
  descriptor.numCreases = static_cast<int>(sharpness.edges.size());
  descriptor.creaseVertexIndexPairs = sharpness.edgeVertices.data();
  descriptor.creaseWeights = sharpness.edges.data();
  descriptor.numCorners = static_cast<int>(sharpness.vertices.size());
  descriptor.cornerVertexIndices = sharpness.vertices.data();
  descriptor.cornerWeights = sharpness.corners.data();
  Far::TopologyDescriptor::FVarChannel uvChannel;
  uvChannel.numValues = static_cast<int>(polygons.uvs.size());
  uvChannel.valueIndices = polygons.faceUvs.data();
  descriptor.numFVarChannels = withUvs ? 1 : 0;
  descriptor.fvarChannels = &uvChannel;

  const auto scheme =
      polygons.scheme == SubdivisionScheme::loop ? Sdc::SCHEME_LOOP : Sdc::SCHEME_CATMARK;
  const RefinerFactory::Options options(scheme, schemeOptions(polygons.border));
  std::unique_ptr<Far::TopologyRefiner> refiner(RefinerFactory::Create(descriptor, options));
  if (!refiner) {
    throw InputError(
        fmt::format("{}: OpenSubdiv cannot connect the faces (a vertex with more than "
                    "{} of them?)",
                    names.source, Far::VALENCE_LIMIT));
  }
  requireManifold(refiner->GetLevel(0), names);
  return refiner;
}

}  // namespace gnomon::surface
