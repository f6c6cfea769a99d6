#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "common/error.h"
#include "surface/readers/ply_parts.h"

namespace gnomon::surface {
namespace {

using Place = std::optional<std::size_t>;

/// Where the coordinates stand among the properties of a vertex.
struct VertexLayout {
  std::array<std::size_t, 3> position{};
  std::optional<std::array<std::size_t, 2>> uv;
  std::optional<std::array<std::size_t, 3>> normal;
};

/// Where corners and their texture coordinates stand among the properties of a face.
struct FaceLayout {
  std::size_t vertices = 0;
  Place uvs;
};

VertexLayout findVertexLayout(const PlyElement& element, const std::string& source) {
  VertexLayout layout;
  constexpr std::array<std::string_view, 3> axes = {"x", "y", "z"};
  for (std::size_t axis = 0; axis < axes.size(); ++axis) {
    const Place found = element.find(axes.at(axis), false);
    if (!found) {
      throw InputError(fmt::format("{}: element 'vertex' has no property '{}', expected x, y and z",
                                   source, axes.at(axis)));
    }
    layout.position.at(axis) = *found;
  }
  using Names = std::pair<std::string_view, std::string_view>;
  for (const auto& [u, v] : {Names("u", "v"), Names("s", "t"), Names("texture_u", "texture_v")}) {
    const Place atU = element.find(u, false);
    const Place atV = element.find(v, false);
    if (atU && atV && !layout.uv) layout.uv = {*atU, *atV};
  }
  const Place nx = element.find("nx", false);
  const Place ny = element.find("ny", false);
  const Place nz = element.find("nz", false);
  if (nx && ny && nz) layout.normal = {*nx, *ny, *nz};
  return layout;
}

FaceLayout findFaceLayout(const PlyElement& element, const std::string& source) {
  Place vertices = element.find("vertex_indices", true);
  if (!vertices) vertices = element.find("vertex_index", true);
  if (!vertices) {
    throw InputError(
        fmt::format("{}: element 'face' has no list 'vertex_indices' or 'vertex_index'", source));
  }
  return {*vertices, element.find("texcoord", true)};
}

double requireFinite(const PlyBody& body, double value, const PlyProperty& property) {
  if (std::isfinite(value)) return value;
  body.fail(fmt::format("'{}' is {}, expected a finite number", property.name, value));
}

/// Reads the rows of one file, element by element, in the file's order.
class MeshReader {
 public:
  MeshReader(const std::string& source, std::string_view bytes, const PlyHeader& header,
             bool withNormals)
      : header_(header), body_(source, bytes, header), withNormals_(withNormals) {
    mesh_.names.source = source;
  }

  PolygonMesh read();

 private:
  template <typename Take>
  void readRows(const PlyElement& element, const Take& take);
  void readVertices(const PlyElement& element);
  void readFaces(const PlyElement& element);
  void takeVertices(const std::vector<double>& indices);
  void takeUvs(const std::vector<double>& uvs, std::size_t corners, const PlyProperty& property);

  const PlyHeader& header_;
  PlyBody body_;
  bool withNormals_;
  PolygonMesh mesh_;
  std::vector<Vec2> vertexUvs_;
  bool facesHaveUvs_ = false;
};

PolygonMesh MeshReader::read() {
  const auto has = [this](std::string_view name) {
    return std::any_of(header_.elements.begin(), header_.elements.end(),
                       [name](const PlyElement& element) { return element.name == name; });
  };
  for (const std::string_view name : {"vertex", "face"}) {
    if (!has(name)) throw InputError(fmt::format("{}: no element '{}'", mesh_.names.source, name));
  }
  for (const PlyElement& element : header_.elements) {
    if (element.name == "vertex") {
      readVertices(element);
    } else if (element.name == "face") {
      readFaces(element);
    } else {
      readRows(element, [](std::size_t, const std::vector<double>&) {});
    }
  }
  body_.end();
  if (!facesHaveUvs_) {
    const bool verticesDo = !vertexUvs_.empty();
    mesh_.faceUvs =
        verticesDo ? mesh_.faceVertices : std::vector<int>(mesh_.faceVertices.size(), noUv);
    mesh_.uvs = std::move(vertexUvs_);
  }
  if (!mesh_.normals.empty()) mesh_.faceNormals = mesh_.faceVertices;
  return std::move(mesh_);
}

/// @param take  called with every property's place and values
template <typename Take>
void MeshReader::readRows(const PlyElement& element, const Take& take) {
  for (std::uint64_t row = 0; row < element.count; ++row) {
    body_.beginRow(element, row);
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      take(i, body_.read(element.properties[i]));
    }
    body_.endRow();
  }
}

void MeshReader::readVertices(const PlyElement& element) {
  VertexLayout layout = findVertexLayout(element, mesh_.names.source);
  if (!withNormals_) layout.normal.reset();
  std::vector<double> row(element.properties.size());
  readRows(element, [&](std::size_t i, const std::vector<double>& values) {
    const PlyProperty& property = element.properties[i];
    const auto isOne = [i](const auto& places) {
      return std::find(places.begin(), places.end(), i) != places.end();
    };
    if (isOne(layout.position) || (layout.uv && isOne(*layout.uv)) ||
        (layout.normal && isOne(*layout.normal))) {
      row[i] = requireFinite(body_, values.front(), property);
    }
    if (i + 1 < row.size()) return;
    const auto& [x, y, z] = layout.position;
    mesh_.positions.emplace_back(row[x], row[y], row[z]);
    if (layout.uv) vertexUvs_.emplace_back(row[(*layout.uv)[0]], row[(*layout.uv)[1]]);
    if (layout.normal) {
      const auto& [nx, ny, nz] = *layout.normal;
      mesh_.normals.emplace_back(row[nx], row[ny], row[nz]);
    }
  });
}

void MeshReader::readFaces(const PlyElement& element) {
  const FaceLayout layout = findFaceLayout(element, mesh_.names.source);
  facesHaveUvs_ = layout.uvs.has_value();
  std::vector<double> uvs;
  readRows(element, [&](std::size_t i, const std::vector<double>& values) {
    if (i == layout.vertices) takeVertices(values);
    if (i == layout.uvs) uvs = values;
    if (i + 1 < element.properties.size() || !layout.uvs) return;
    takeUvs(uvs, static_cast<std::size_t>(mesh_.faceSizes.back()), element.properties[*layout.uvs]);
  });
}

void MeshReader::takeVertices(const std::vector<double>& indices) {
  mesh_.faceSizes.push_back(static_cast<int>(indices.size()));
  if (body_.line() > 0) mesh_.names.faceLines.push_back(body_.line());
  for (const double index : indices) {
    // `makeTopologyRefiner` knows how many vertices there are; here only what an index cannot be.
    if (!(index >= 0 && index <= std::numeric_limits<int>::max() && index == std::floor(index))) {
      body_.fail(fmt::format("vertex index {}, expected a whole number from 0", index));
    }
    mesh_.faceVertices.push_back(static_cast<int>(index));
  }
}

void MeshReader::takeUvs(const std::vector<double>& uvs, std::size_t corners,
                         const PlyProperty& property) {
  if (uvs.empty()) {
    mesh_.faceUvs.insert(mesh_.faceUvs.end(), corners, noUv);
    return;
  }
  if (uvs.size() != 2 * corners) {
    body_.fail(fmt::format("'{}' has {} values, expected u and v of {} corners, or none",
                           property.name, uvs.size(), corners));
  }
  for (std::size_t i = 0; i < uvs.size(); i += 2) {
    mesh_.faceUvs.push_back(static_cast<int>(mesh_.uvs.size()));
    mesh_.uvs.emplace_back(requireFinite(body_, uvs[i], property),
                           requireFinite(body_, uvs[i + 1], property));
  }
}

/// Reads the bytes of a PLY (Turk 1994): ASCII, or binary of either byte order; polygons of any
/// size. It takes
/// - of `vertex`: x, y, z, and where they are there texture coordinates: u, v, or s, t, or
///   texture_u, texture_v; and where they are asked for and are there, normals: nx, ny, nz;
/// - of `face`: the list vertex_indices, or vertex_index, and where it is there the list texcoord:
///   u and v of each corner. It rules over the vertices' own. Empty for a face, that face has none:
///   there are no frames on it.
///
/// All other elements and properties are skipped, sharp edges among them.
/// @param source       the file, as messages name it
/// @param withNormals  reads normals too, which are else not looked at
/// @throws InputError naming file and line, or in a binary file element, row and byte: a header
/// that
///   readPlyHeader refuses, no vertices or faces with these properties, a file that ends early or
///   goes on after its last row, a value that is malformed, out of its type's range or not finite,
///   a texcoord that has not two values for each corner
PolygonMesh readPly(const std::string& source, std::string_view bytes, bool withNormals) {
  const PlyHeader header = readPlyHeader(source, bytes);
  return MeshReader(source, bytes, header, withNormals).read();
}

bool beginsAsPly(std::string_view bytes) {
  return bytes.starts_with("ply\n") || bytes.starts_with("ply\r");
}

}  // namespace

extern const MeshFormat plyFormat;
/// Memory: a face of a binary file may take no more than ten bytes, with its corners' vertices and
/// texture coordinates as many again; here some hundred a corner, and OpenSubdiv's two levels.
const MeshFormat plyFormat = {"PLY", ".ply", 60, &readPly, &beginsAsPly};

}  // namespace gnomon::surface
