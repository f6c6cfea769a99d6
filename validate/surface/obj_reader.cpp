#include "surface/obj_reader.h"

#include <fmt/format.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>
#include <string_view>

#include "common/atomic_file.h"
#include "common/error.h"
#include "common/memory.h"
#include "surface/topology.h"

namespace gnomon {
namespace {

namespace Far = OpenSubdiv::Far;

/// tinyobjloader counts the corners of a face in a byte.
constexpr std::size_t mostCorners = 255;

/// A mesh of faces of any size, with the lines that it came from.
struct PolygonMesh {
  std::vector<Vec3> positions;
  std::vector<int> faceSizes;
  std::vector<int> faceVertices;
  std::vector<Vec2> uvs;
  std::vector<int> faceUvs;
  std::vector<Crease> creases;
  std::vector<SharpVertex> sharpVertices;
};

/// One line of the file, cut at blanks.
struct Line {
  const std::string& source;
  int number;
  std::vector<std::string_view> tokens;

  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(fmt::format("{}:{}: {}", source, number, message));
  }
};

/// A token as an error message may show it: printable, and not long.
std::string quote(std::string_view token) {
  std::string text(token.substr(0, 40));
  for (char& c : text) {
    if (c < ' ' || c > '~') c = '?';
  }
  return fmt::format("'{}'{}", text, token.size() > text.size() ? "…" : "");
}

template <typename Number>
std::optional<Number> parse(std::string_view token) {
  if (token.starts_with('+')) token.remove_prefix(1);
  Number value{};
  const char* end = token.data() + token.size();
  const auto [stop, error] = std::from_chars(token.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

int parseInteger(const Line& line, std::string_view token, std::string_view what) {
  const auto value = parse<int>(token);
  if (!value) line.fail(fmt::format("{} is {}, expected an integer", what, quote(token)));
  return *value;
}

double parseFinite(const Line& line, std::string_view token, std::string_view what) {
  const auto value = parse<double>(token);
  if (!value || !std::isfinite(*value)) {
    line.fail(fmt::format("{} is {}, expected a finite number", what, quote(token)));
  }
  return *value;
}

/// The lines that matter, checked strictly. tinyobjloader reads a number that is none as 0, a "nan"
/// too, does not tell the line of a face, and loses tags after the last group; so what it gets are
/// lines known to be well formed, and tags are read here.
class LineReader {
 public:
  explicit LineReader(const std::string& source) { names_.source = source; }

  void read(std::string_view text);

  [[nodiscard]] const std::string& elements() const { return elements_; }
  [[nodiscard]] PartNames& names() { return names_; }
  [[nodiscard]] std::vector<Crease>& creases() { return creases_; }
  [[nodiscard]] std::vector<SharpVertex>& sharpVertices() { return sharpVertices_; }

 private:
  void readLine(std::string_view text, int number);
  void readVector(const Line& line, std::size_t size);
  void readFace(const Line& line);
  void readCorner(const Line& line, std::string_view token);
  void readTag(const Line& line);
  void appendIndex(const Line& line, std::string_view token, std::size_t count,
                   std::string_view what);

  std::string elements_;
  PartNames names_;
  std::vector<Crease> creases_;
  std::vector<SharpVertex> sharpVertices_;
  std::size_t vertices_ = 0;
  std::size_t uvs_ = 0;
};

void LineReader::read(std::string_view text) {
  constexpr std::string_view byteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(byteOrderMark)) text.remove_prefix(byteOrderMark.size());
  names_.firstFace = 1;
  elements_.reserve(text.size());
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t length = std::min(text.find_first_of("\r\n"), text.size());
    readLine(text.substr(0, length), number);
    text.remove_prefix(length);
    if (text.starts_with("\r\n")) text.remove_prefix(1);
    if (!text.empty()) text.remove_prefix(1);
  }
}

void LineReader::readLine(std::string_view text, int number) {
  text = text.substr(0, text.find('#'));
  Line line{names_.source, number, {}};
  constexpr std::string_view blanks = " \t";
  for (std::size_t begin = text.find_first_not_of(blanks); begin != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(blanks, begin), text.size());
    line.tokens.push_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(blanks, end);
  }
  if (line.tokens.empty()) return;
  const std::string_view keyword = line.tokens.front();
  if (keyword == "v") {
    readVector(line, 3);
    ++vertices_;
  } else if (keyword == "vt") {
    readVector(line, 2);
    ++uvs_;
  } else if (keyword == "f") {
    readFace(line);
  } else if (keyword == "t") {
    readTag(line);
  }
}

void LineReader::readVector(const Line& line, std::size_t size) {
  if (line.tokens.size() < size + 1) {
    line.fail(fmt::format("'{}' with {} numbers, expected {}", line.tokens[0],
                          line.tokens.size() - 1, size));
  }
  elements_ += line.tokens[0];
  for (std::size_t i = 1; i <= size; ++i) {
    parseFinite(line, line.tokens[i], fmt::format("coordinate {}", i));
    elements_ += ' ';
    elements_ += line.tokens[i];
  }
  elements_ += '\n';
}

void LineReader::readFace(const Line& line) {
  const std::size_t corners = line.tokens.size() - 1;
  if (corners < 3 || corners > mostCorners) {
    line.fail(fmt::format("face with {} corners, expected 3 to {}", corners, mostCorners));
  }
  elements_ += 'f';
  for (std::size_t i = 1; i <= corners; ++i) readCorner(line, line.tokens[i]);
  elements_ += '\n';
  names_.faceLines.push_back(line.number);
}

void LineReader::readCorner(const Line& line, std::string_view token) {
  const std::size_t slash = std::min(token.find('/'), token.size());
  elements_ += ' ';
  appendIndex(line, token.substr(0, slash), vertices_, "vertex");
  const std::string_view rest = token.substr(std::min(slash + 1, token.size()));
  const std::string_view uv = rest.substr(0, rest.find('/'));
  if (uv.empty()) {
    line.fail(
        fmt::format("corner {} has no texture coordinate, expected vertex/texture: unwrap "
                    "the mesh and export it with its UVs",
                    quote(token)));
  }
  elements_ += '/';
  appendIndex(line, uv, uvs_, "texture coordinate");
}

void LineReader::appendIndex(const Line& line, std::string_view token, std::size_t count,
                             std::string_view what) {
  const int index = parseInteger(line, token, fmt::format("{} index", what));
  // Counted backwards from here, or from the start of the whole file, which is not known yet.
  if (index == 0 || (index < 0 && static_cast<std::size_t>(-static_cast<long>(index)) > count)) {
    line.fail(fmt::format("{} index {}, expected 1 or more, or -1 to -{}", what, index, count));
  }
  elements_ += std::to_string(index);
}

/// `t NAME integers/reals/strings …` as OpenSubdiv's own files have it, vertices counted from 0:
/// `t crease 2/1/0 v1 v2 sharpness`, `t corner 1/1/0 v sharpness`; several edges or vertices may
/// share one tag, with one sharpness for all or one each.
void LineReader::readTag(const Line& line) {
  if (line.tokens.size() < 3) line.fail("tag without name or counts, expected 't NAME i/r/s …'");
  const std::string_view name = line.tokens[1];
  if (name == "interpolateboundary" || name == "facevaryinginterpolateboundary") return;
  if (name != "crease" && name != "corner") {
    line.fail(fmt::format("tag {}, expected crease or corner", quote(name)));
  }
  const std::size_t verticesEach = name == "crease" ? 2 : 1;
  const std::string_view counts = line.tokens[2];
  const std::size_t slash = std::min(counts.find('/'), counts.size());
  const std::string_view rest = counts.substr(std::min(slash + 1, counts.size()));
  const auto integers = parse<unsigned>(counts.substr(0, slash)).value_or(0);
  const auto reals = parse<unsigned>(rest.substr(0, rest.find('/'))).value_or(0);
  const std::size_t parts = integers / verticesEach;
  const bool wellFormed = integers > 0 && integers % verticesEach == 0 &&
                          (reals == 1 || reals == parts) &&
                          line.tokens.size() == 3 + std::size_t{integers} + reals;
  if (!wellFormed) {
    line.fail(fmt::format("{} {} with {} values, expected '{}/1/0', {} vertices and a sharpness",
                          name, quote(counts), line.tokens.size() - 3, verticesEach, verticesEach));
  }
  for (std::size_t i = 0; i < parts; ++i) {
    const std::string_view* vertex = &line.tokens[3 + i * verticesEach];
    const std::string_view real = line.tokens[3 + integers + (reals == 1 ? 0 : i)];
    const double sharpness = parseFinite(line, real, "sharpness");
    const int first = parseInteger(line, vertex[0], "vertex index");
    if (verticesEach == 2) {
      creases_.push_back({{first, parseInteger(line, vertex[1], "vertex index")}, sharpness});
      names_.creaseLines.push_back(line.number);
    } else {
      sharpVertices_.push_back({first, sharpness});
      names_.sharpVertexLines.push_back(line.number);
    }
  }
}

PolygonMesh load(LineReader& lines) {
  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::string warning;
  std::string error;
  std::istringstream stream(lines.elements());
  const std::string& source = lines.names().source;
  if (!tinyobj::LoadObj(&attributes, &shapes, &materials, &warning, &error, &stream, nullptr,
                        false)) {
    throw InputError(fmt::format("{}: {}", source, error.substr(0, error.find('\n'))));
  }
  PolygonMesh mesh;
  for (std::size_t i = 0; i + 2 < attributes.vertices.size(); i += 3) {
    mesh.positions.emplace_back(attributes.vertices[i], attributes.vertices[i + 1],
                                attributes.vertices[i + 2]);
  }
  for (std::size_t i = 0; i + 1 < attributes.texcoords.size(); i += 2) {
    mesh.uvs.emplace_back(attributes.texcoords[i], attributes.texcoords[i + 1]);
  }
  for (const tinyobj::shape_t& shape : shapes) {
    for (const unsigned char size : shape.mesh.num_face_vertices) mesh.faceSizes.push_back(size);
    for (const tinyobj::index_t& index : shape.mesh.indices) {
      mesh.faceVertices.push_back(index.vertex_index);
      mesh.faceUvs.push_back(index.texcoord_index);
    }
  }
  if (mesh.faceSizes.size() != lines.names().faceLines.size()) {
    throw InternalError(fmt::format("{}: {} faces in the file, {} read", source,
                                    lines.names().faceLines.size(), mesh.faceSizes.size()));
  }
  mesh.creases = std::move(lines.creases());
  mesh.sharpVertices = std::move(lines.sharpVertices());
  return mesh;
}

std::unique_ptr<Far::TopologyRefiner> connectMesh(const PolygonMesh& mesh, const PartNames& names,
                                                  SubdivisionScheme scheme) {
  return connect({.positions = mesh.positions,
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
Cage refine(const PolygonMesh& mesh, Far::TopologyRefiner& refiner) {
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
  }
  takeSharpness(level, cage);
  return cage;
}

Cage toCage(PolygonMesh mesh, SubdivisionScheme scheme) {
  Cage cage;
  cage.scheme = scheme;
  cage.positions = std::move(mesh.positions);
  cage.faceVertices = std::move(mesh.faceVertices);
  cage.uvs = std::move(mesh.uvs);
  cage.faceUvs = std::move(mesh.faceUvs);
  cage.creases = std::move(mesh.creases);
  cage.sharpVertices = std::move(mesh.sharpVertices);
  return cage;
}

}  // namespace

Cage readObj(const std::filesystem::path& path, SubdivisionScheme scheme) {
  std::error_code error;
  const auto bytes = std::filesystem::file_size(path, error);
  // Text, its checked copy, tinyobjloader's arrays and ours, OpenSubdiv's two levels.
  if (!error) requireMemory(30.0 * static_cast<double>(bytes), path.string());
  LineReader lines(path.string());
  lines.read(readFile(path));
  PolygonMesh mesh = load(lines);
  const bool loop = scheme == SubdivisionScheme::loop;
  const auto odd = std::find_if(mesh.faceSizes.begin(), mesh.faceSizes.end(),
                                [loop](int size) { return size != (loop ? 3 : 4); });
  const bool even = odd == mesh.faceSizes.end();
  if (loop && !even) {
    const auto face = static_cast<std::size_t>(odd - mesh.faceSizes.begin());
    throw InputError(fmt::format("{} has {} corners, but Loop's scheme takes triangles only",
                                 lines.names().face(face), *odd));
  }
  const auto refiner = connectMesh(mesh, lines.names(), scheme);
  return even ? toCage(std::move(mesh), scheme) : refine(mesh, *refiner);
}

}  // namespace gnomon
