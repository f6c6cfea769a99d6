#include "surface/readers/polygon_mesh.h"

#include <fmt/format.h>
#include <opensubdiv/far/primvarRefiner.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "common/error.h"

namespace gnomon::surface {
namespace {

namespace Far = OpenSubdiv::Far;

/// One point of the texture for all corners that have none: no area, and so no frame.
void giveMissingUvs(PolygonMesh& mesh, const PartNames& names) {
  const auto missing = std::count(mesh.faceUvs.begin(), mesh.faceUvs.end(), noUv);
  if (missing == 0) return;
  if (static_cast<std::size_t>(missing) == mesh.faceUvs.size()) {
    throw InputError(fmt::format(
        "{}: no face has texture coordinates: unwrap the mesh and export it with its UVs",
        names.source));
  }
  std::replace(mesh.faceUvs.begin(), mesh.faceUvs.end(), noUv, static_cast<int>(mesh.uvs.size()));
  mesh.uvs.emplace_back(0, 0);
}

std::unique_ptr<Far::TopologyRefiner> connectMesh(const PolygonMesh& mesh, const PartNames& names,
                                                  SubdivisionScheme scheme) {
  return makeTopologyRefiner({.positions = mesh.positions,
                              .faceSizes = mesh.faceSizes,
                              .faceVertices = mesh.faceVertices,
                              .uvs = mesh.uvs,
                              .faceUvs = mesh.faceUvs,
                              .creases = mesh.creases,
                              .sharpVertices = mesh.sharpVertices,
                              .border = CageBorder::edgesAndCorners,
                              .scheme = scheme},
                             names, true);
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
Cage refine(PolygonMesh& mesh, Far::TopologyRefiner& refiner) {
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
    if (mesh.faceParts.empty()) continue;
    const auto parent = static_cast<std::size_t>(level.GetFaceParentFace(face));
    cage.faceParts.push_back(mesh.faceParts[parent]);
  }
  cage.partNames = std::move(mesh.partNames);
  takeSharpness(level, cage);
  return cage;
}

Cage unrefined(PolygonMesh mesh, SubdivisionScheme scheme) {
  Cage cage;
  cage.scheme = scheme;
  cage.positions = std::move(mesh.positions);
  cage.faceVertices = std::move(mesh.faceVertices);
  cage.uvs = std::move(mesh.uvs);
  cage.faceUvs = std::move(mesh.faceUvs);
  cage.creases = std::move(mesh.creases);
  cage.sharpVertices = std::move(mesh.sharpVertices);
  cage.partNames = std::move(mesh.partNames);
  cage.faceParts = std::move(mesh.faceParts);
  return cage;
}

}  // namespace

Cage toCage(PolygonMesh mesh, const PartNames& names, SubdivisionScheme scheme) {
  giveMissingUvs(mesh, names);
  const bool loop = scheme == SubdivisionScheme::loop;
  const auto odd = std::find_if(mesh.faceSizes.begin(), mesh.faceSizes.end(),
                                [loop](int size) { return size != (loop ? 3 : 4); });
  const bool even = odd == mesh.faceSizes.end();
  if (loop && !even) {
    const auto face = static_cast<std::size_t>(odd - mesh.faceSizes.begin());
    throw InputError(fmt::format("{} has {} corners, but Loop's scheme takes triangles only",
                                 names.face(face), *odd));
  }
  const auto refiner = connectMesh(mesh, names, scheme);
  return even ? unrefined(std::move(mesh), scheme) : refine(mesh, *refiner);
}

}  // namespace gnomon::surface
