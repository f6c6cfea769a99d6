#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "common/error.h"
#include "surface/readers/polygon_mesh.h"

namespace gnomon::surface {
namespace {

/// tinyobjloader counts the corners of a face in a byte.
constexpr std::size_t mostCorners = 255;
constexpr const char* unnamedPart = "unnamed";

/// A comment goes from # to the end of the line.
/// @return whether there is one
bool dropComment(std::vector<std::string_view>& tokens) {
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const std::size_t hash = tokens[i].find('#');
    if (hash == std::string_view::npos) continue;
    tokens[i] = tokens[i].substr(0, hash);
    tokens.resize(hash == 0 ? i : i + 1);
    return true;
  }
  return false;
}

/// Whether a line of numbers goes on in the next, by a \\ at its end, which is dropped. Names and
/// paths of other lines may end in one.
bool dropContinuation(std::vector<std::string_view>& tokens) {
  constexpr std::array<std::string_view, 5> keywords = {"v", "vt", "vn", "f", "t"};
  if (tokens.empty() || !tokens.back().ends_with('\\') ||
      std::find(keywords.begin(), keywords.end(), tokens.front()) == keywords.end()) {
    return false;
  }
  tokens.back().remove_suffix(1);
  if (tokens.back().empty()) tokens.pop_back();
  return true;
}

std::string partOf(const TextLine& line) {
  return std::string(line.tokens.size() > 1 ? line.tokens[1] : unnamedPart);
}

/// The lines that matter, checked strictly. tinyobjloader reads a number that is none as 0, a "nan"
/// too, does not tell the line of a face, and loses tags after the last group; so what it gets are
/// lines known to be well formed, and tags are read here.
class LineReader {
 public:
  LineReader(const std::string& source, bool withNormals) : withNormals_(withNormals) {
    names_.source = source;
  }

  void read(std::string_view text);

  [[nodiscard]] const std::string& elements() const { return elements_; }
  [[nodiscard]] PartNames& names() { return names_; }
  [[nodiscard]] std::vector<Crease>& creases() { return creases_; }
  [[nodiscard]] std::vector<SharpVertex>& sharpVertices() { return sharpVertices_; }
  /// The object of each face, or in a file without any its group.
  [[nodiscard]] std::vector<std::string>& parts() { return hasObjects_ ? objects_ : groups_; }

 private:
  void readLine(const TextLine& line);
  void readVector(const TextLine& line, std::size_t size);
  void readFace(const TextLine& line);
  /// False for a corner without texture coordinates.
  bool readCorner(const TextLine& line, std::string_view token);
  void readTag(const TextLine& line);
  void appendIndex(const TextLine& line, std::string_view token, std::size_t count,
                   std::string_view what);

  bool withNormals_;
  std::string elements_;
  PartNames names_;
  std::vector<Crease> creases_;
  std::vector<SharpVertex> sharpVertices_;
  std::string object_ = unnamedPart, group_ = unnamedPart;  ///< that the next face is of
  bool hasObjects_ = false;
  std::vector<std::string> objects_, groups_;  ///< of each face
  std::size_t vertices_ = 0;
  std::size_t uvs_ = 0;
  std::size_t normals_ = 0;
};

void LineReader::read(std::string_view text) {
  constexpr std::string_view byteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(byteOrderMark)) text.remove_prefix(byteOrderMark.size());
  names_.firstFace = 1;
  elements_.reserve(text.size());
  TextLines lines(names_.source, text);
  while (auto line = lines.next()) {
    while (!dropComment(line->tokens) && dropContinuation(line->tokens)) {
      const auto more = lines.next();
      if (!more) break;
      line->tokens.insert(line->tokens.end(), more->tokens.begin(), more->tokens.end());
    }
    readLine(*line);
  }
}

void LineReader::readLine(const TextLine& line) {
  if (line.tokens.empty()) return;
  const std::string_view keyword = line.tokens.front();
  if (keyword == "v") {
    readVector(line, 3);
    ++vertices_;
  } else if (keyword == "vt") {
    readVector(line, 2);
    ++uvs_;
  } else if (keyword == "vn" && withNormals_) {
    readVector(line, 3);
    ++normals_;
  } else if (keyword == "f") {
    readFace(line);
  } else if (keyword == "t") {
    readTag(line);
  } else if (keyword == "o") {
    object_ = partOf(line);
    hasObjects_ = true;
  } else if (keyword == "g") {
    group_ = partOf(line);
  }
}

void LineReader::readVector(const TextLine& line, std::size_t size) {
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

void LineReader::readFace(const TextLine& line) {
  const std::size_t corners = line.tokens.size() - 1;
  if (corners < 3 || corners > mostCorners) {
    line.fail(fmt::format("face with {} corners, expected 3 to {}", corners, mostCorners));
  }
  elements_ += 'f';
  std::size_t withUv = 0;
  for (std::size_t i = 1; i <= corners; ++i) withUv += readCorner(line, line.tokens[i]) ? 1 : 0;
  if (withUv != 0 && withUv != corners) {
    line.fail(
        fmt::format("face with {} corners, {} of them with a texture coordinate, expected all "
                    "or none: vertex/texture",
                    corners, withUv));
  }
  elements_ += '\n';
  names_.faceLines.push_back(line.number);
  objects_.push_back(object_);
  groups_.push_back(group_);
}

bool LineReader::readCorner(const TextLine& line, std::string_view token) {
  const std::size_t slash = std::min(token.find('/'), token.size());
  elements_ += ' ';
  appendIndex(line, token.substr(0, slash), vertices_, "vertex");
  const std::string_view rest = token.substr(std::min(slash + 1, token.size()));
  const std::string_view uv = rest.substr(0, rest.find('/'));
  const std::size_t second = std::min(rest.find('/'), rest.size());
  const std::string_view normal = rest.substr(std::min(second + 1, rest.size()));
  if (!uv.empty()) {
    elements_ += '/';
    appendIndex(line, uv, uvs_, "texture coordinate");
  }
  if (withNormals_ && !normal.empty()) {
    elements_ += uv.empty() ? "//" : "/";
    appendIndex(line, normal, normals_, "normal");
  }
  return !uv.empty();
}

void LineReader::appendIndex(const TextLine& line, std::string_view token, std::size_t count,
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
void LineReader::readTag(const TextLine& line) {
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
  const auto integers = parseNumber<unsigned>(counts.substr(0, slash)).value_or(0);
  const auto reals = parseNumber<unsigned>(rest.substr(0, rest.find('/'))).value_or(0);
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
  if (!tinyobj::LoadObj(&attributes, &shapes, &materials, &warning, &error, &stream, nullptr,
                        false)) {
    throw InputError(
        fmt::format("{}: {}", lines.names().source, error.substr(0, error.find('\n'))));
  }
  PolygonMesh mesh;
  mesh.names = std::move(lines.names());
  for (std::size_t i = 0; i + 2 < attributes.vertices.size(); i += 3) {
    mesh.positions.emplace_back(attributes.vertices[i], attributes.vertices[i + 1],
                                attributes.vertices[i + 2]);
  }
  for (std::size_t i = 0; i + 1 < attributes.texcoords.size(); i += 2) {
    mesh.uvs.emplace_back(attributes.texcoords[i], attributes.texcoords[i + 1]);
  }
  for (std::size_t i = 0; i + 2 < attributes.normals.size(); i += 3) {
    mesh.normals.emplace_back(attributes.normals[i], attributes.normals[i + 1],
                              attributes.normals[i + 2]);
  }
  for (const tinyobj::shape_t& shape : shapes) {
    for (const unsigned char size : shape.mesh.num_face_vertices) mesh.faceSizes.push_back(size);
    for (const tinyobj::index_t& index : shape.mesh.indices) {
      mesh.faceVertices.push_back(index.vertex_index);
      mesh.faceUvs.push_back(index.texcoord_index);
      if (!mesh.normals.empty()) mesh.faceNormals.push_back(index.normal_index);
    }
  }
  if (mesh.faceSizes.size() != mesh.names.faceLines.size()) {
    throw InternalError(fmt::format("{}: {} faces in the file, {} read", mesh.names.source,
                                    mesh.names.faceLines.size(), mesh.faceSizes.size()));
  }
  mesh.creases = std::move(lines.creases());
  mesh.sharpVertices = std::move(lines.sharpVertices());
  mesh.faceNames = std::move(lines.parts());
  return mesh;
}

/// Reads the text of a Wavefront OBJ: n-gons, face-varying texture coordinates, and the tags `t
/// crease` and `t corner` that OpenSubdiv's own files use (vertices counted from 0). Faces are
/// named by the objects (`o`) of a file that has any, else by its groups (`g`, the first name of a
/// line); "unnamed" before the first. A line of numbers may go on in the next, by a \\ at its end.
/// Borders are edgesAndCorners, whatever the file's `t interpolateboundary` says; any other tag is
/// an error, since it would change the surface.
/// @param source       the file, as messages name it
/// @param withNormals  reads `vn` too, which is else not looked at
/// @throws InputError naming file and line: an index that is 0 or counts back too far, a number
/// that
///   is malformed or not finite, texture coordinates at some corners of a face only, a face of
///   fewer than 3 or more than 255 corners
PolygonMesh readObj(const std::string& source, std::string_view text, bool withNormals) {
  LineReader lines(source, withNormals);
  lines.read(text);
  return load(lines);
}

}  // namespace

extern const MeshFormat objFormat;
/// Memory: text, its checked copy, tinyobjloader's arrays and ours, OpenSubdiv's two levels.
const MeshFormat objFormat = {"OBJ", ".obj", 30, &readObj};

}  // namespace gnomon::surface
