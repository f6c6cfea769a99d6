#pragma once

#include <charconv>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "common/vec.h"
#include "surface/cage/cage.h"

namespace gnomon::surface {

// Shared by the sources of this component; no other component includes it.

/// What `PolygonMesh::faceUvs` holds at every corner of a face without texture coordinates.
constexpr int noUv = -1;

/// Faces of any size, as a file has them. Faces follow each other in `faceVertices` and, corner by
/// corner, in `faceUvs`.
struct PolygonMesh {
  PartNames names;  ///< for messages
  std::vector<Vec3> positions;
  std::vector<int> faceSizes;
  std::vector<int> faceVertices;
  std::vector<Vec2> uvs;
  std::vector<int> faceUvs;
  std::vector<Vec3> normals;     ///< read for scheme `none` alone; of any length
  std::vector<int> faceNormals;  ///< of each corner, -1 where it has none; empty in a file of none
  std::vector<Crease> creases;
  std::vector<SharpVertex> sharpVertices;
  std::vector<std::string> faceNames;  ///< the part that each face is of; empty in a file of none
};

/// The mesh as a control cage.
/// - Vertices in the very same place become one where faces meet there: an edge of one face and an
///   edge of another that have the same ends and run in opposite directions are one edge, unless
///   more edges lie there. An edge without length joins nothing. Writers cut a mesh apart at seams
///   of its texture or at sharp edges, and its surface continues there. Numbers stay the file's:
///   the first of joined vertices stands for all.
/// - Faces without texture coordinates get some without area, so that no frame exists on them.
/// - Parts are numbered in the order of their first faces. A mesh with one part, or more than
///   `mostParts`, has none to tell apart.
/// - A Catmull-Clark cage with any face that is not a quadrilateral is refined once, so that every
///   face of the result is one; the limit surface is the same, and texture coordinates are halved
///   linearly.
/// - Scheme `none`: the polygons as they are, see makePolygonCage; creases mean nothing there.
/// @throws InputError naming the part: no face, or none with texture coordinates; for Loop's scheme
///   a face that is no triangle; and all that `makeTopologyRefiner` refuses
Cage toCage(PolygonMesh mesh, SubdivisionScheme scheme);

/// A format of mesh files. `readers/NAME_reader.cpp` defines it as `NAMEFormat`, declared here for
/// the list that the build makes of all.
struct MeshFormat {
  std::string_view name;    ///< "PLY"
  std::string_view ending;  ///< of a file's name, lower case: ".ply"
  double memory;            ///< bytes that reading takes at most, for each byte of the file
  /// @param source       the file, as messages name it
  /// @param withNormals  reads the file's normals too, which are else not looked at
  /// @throws InputError naming the file and the place in it
  PolygonMesh (*read)(const std::string& source, std::string_view bytes, bool withNormals);
  /// Whether bytes begin as only files of this format do; null where these may begin in any way.
  bool (*begins)(std::string_view bytes) = nullptr;
};
std::span<const MeshFormat* const> meshFormats();

/// One line of a text file, cut at spaces and tabs.
struct TextLine {
  const std::string& source;  ///< the file, as messages name it
  int number = 0;             ///< from 1
  std::vector<std::string_view> tokens;

  /// @throws InputError "source:number: message"
  [[noreturn]] void fail(const std::string& message) const;
};

/// Goes through a text line by line; lines end with "\n", "\r\n" or "\r".
class TextLines {
 public:
  /// @param text        must outlive the lines
  /// @param lineNumber  of the text's first line in its file
  TextLines(const std::string& source, std::string_view text, int lineNumber = 1)
      : source_(source), rest_(text), next_(lineNumber) {}

  /// Empty after the last line; a line without tokens is blank.
  std::optional<TextLine> next();
  /// What comes after the lines given so far.
  [[nodiscard]] std::string_view rest() const { return rest_; }

 private:
  const std::string& source_;
  std::string_view rest_;
  int next_;
};

/// A token as an error message may show it: printable, and not long.
std::string quote(std::string_view token);

/// The number that the whole token is, a leading + allowed; empty where it is none, or out of the
/// type's range.
template <typename Number>
std::optional<Number> parseNumber(std::string_view token) {
  if (token.starts_with('+')) token.remove_prefix(1);
  Number value{};
  const char* end = token.data() + token.size();
  const auto [stop, error] = std::from_chars(token.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

/// @param what  opens the message: "coordinate 2"
/// @throws InputError naming the line and the token
int parseInteger(const TextLine& line, std::string_view token, std::string_view what);
double parseFinite(const TextLine& line, std::string_view token, std::string_view what);

}  // namespace gnomon::surface
