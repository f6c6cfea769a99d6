#include "surface/mesh_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "common/system/memory.h"
#include "surface/readers/polygon_mesh.h"

namespace gnomon::surface {
namespace {

/// "OBJ or PLY": something of all formats.
std::string anyFormat(std::string_view MeshFormat::*what) {
  std::vector<std::string_view> texts;
  for (const MeshFormat* format : meshFormats()) texts.push_back(format->*what);
  return fmt::format("{}", fmt::join(texts, " or "));
}

constexpr std::string_view compressed = "is compressed ({}): unpack it";
constexpr std::string_view otherText = "is text in {}: save it as UTF-8 or ASCII";
constexpr std::string_view otherFormat = "is {}: export the mesh as ";

/// What the first bytes of a file tell that is no mesh of these formats.
struct Signature {
  std::string_view bytes;
  std::string_view sentence;
  std::string_view kind;
};
using namespace std::string_view_literals;
constexpr std::array<Signature, 12> signatures = {{{"\x1f\x8b"sv, compressed, "gzip"},
                                                   {"PK\x03\x04"sv, compressed, "zip"},
                                                   {"BZh"sv, compressed, "bzip2"},
                                                   {"\xfd\x37zXZ"sv, compressed, "xz"},
                                                   {"\x28\xb5\x2f\xfd"sv, compressed, "zstd"},
                                                   {"\xff\xfe"sv, otherText, "UTF-16"},
                                                   {"\xfe\xff"sv, otherText, "UTF-16"},
                                                   {"glTF"sv, otherFormat, "a binary glTF"},
                                                   {"Kaydara FBX"sv, otherFormat, "an FBX"},
                                                   {"BLENDER"sv, otherFormat, "a file of Blender"},
                                                   {"solid "sv, otherFormat, "an STL"},
                                                   {"<?xml"sv, otherFormat, "XML"}}};

void requireMesh(const std::string& source, std::string_view bytes, const MeshFormat& format) {
  for (const MeshFormat* other : meshFormats()) {
    if (other->begins == nullptr || !other->begins(bytes)) continue;
    if (other == &format) return;
    throw InputError(fmt::format("{}: is a {}: a name that ends in {} expected", source,
                                 other->name, other->ending));
  }
  const auto refuse = [&](std::string_view sentence, std::string_view kind) {
    std::string text = source + ": " + fmt::format(fmt::runtime(sentence), kind);
    if (sentence == otherFormat) text += anyFormat(&MeshFormat::name);
    throw InputError(text);
  };
  for (const auto& [begin, sentence, kind] : signatures) {
    if (bytes.starts_with(begin)) refuse(sentence, kind);
  }
  // Without a byte order mark: of the first two letters every other byte is 0.
  const std::string_view head = bytes.substr(0, 4);
  if (std::count(head.begin(), head.end(), '\0') == 2) refuse(otherText, "UTF-16");
}

PolygonMesh readPolygons(const std::filesystem::path& path, bool withNormals) {
  const std::string source = path.string();
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  const auto formats = meshFormats();
  const auto found = std::find_if(formats.begin(), formats.end(),
                                  [&](const MeshFormat* one) { return one->ending == ending; });
  if (found == formats.end()) {
    throw InputError(fmt::format("{}: a mesh file that ends in {} expected", source,
                                 anyFormat(&MeshFormat::ending)));
  }
  const MeshFormat& format = **found;
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (!error) requireMemory(format.memory * static_cast<double>(size), source);
  const std::string bytes = readFile(path);
  requireMesh(source, bytes, format);
  return format.read(source, bytes, withNormals);
}

}  // namespace

Cage readMeshFile(const std::filesystem::path& path, SubdivisionScheme scheme) {
  return toCage(readPolygons(path, scheme == SubdivisionScheme::none), scheme);
}

std::string schemeChoice(const std::filesystem::path& path) {
  const PolygonMesh mesh = readPolygons(path, false);
  const auto countOf = [&mesh](int corners) {
    return std::count(mesh.faceSizes.begin(), mesh.faceSizes.end(), corners);
  };
  const auto all = static_cast<std::ptrdiff_t>(mesh.faceSizes.size());
  const auto triangles = countOf(3);
  const auto quadrilaterals = countOf(4);
  std::vector<std::string> kinds;
  const auto add = [&kinds](std::ptrdiff_t count, const char* one, const char* several) {
    if (count > 0) kinds.push_back(fmt::format("{} {}", count, count == 1 ? one : several));
  };
  add(triangles, "triangle", "triangles");
  add(quadrilaterals, "quadrilateral", "quadrilaterals");
  add(all - triangles - quadrilaterals, "larger polygon", "larger polygons");
  const bool isLoop = triangles == all;
  return fmt::format(
      "{}: catmull-clark would round {} to a smooth surface, as the control cage of a subdivision "
      "surface (a box becomes a ball){}; none keeps {}",
      fmt::join(kinds, ", "), all == 1 ? "it" : "them",
      isLoop ? ", loop too" : ", loop cannot take what is no triangle", all == 1 ? "it" : "them");
}

}  // namespace gnomon::surface
