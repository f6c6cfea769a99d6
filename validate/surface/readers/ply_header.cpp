#include "surface/readers/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "surface/readers/text_line.h"

namespace gnomon::surface {
namespace {

struct TypeName {
  std::string_view name;      ///< as Turk's first files have it
  std::string_view sizeName;  ///< as later ones do
  std::size_t size;
};

/// In the order of PlyType.
constexpr std::array<TypeName, 8> typeNames = {{{"char", "int8", 1},
                                                {"uchar", "uint8", 1},
                                                {"short", "int16", 2},
                                                {"ushort", "uint16", 2},
                                                {"int", "int32", 4},
                                                {"uint", "uint32", 4},
                                                {"float", "float32", 4},
                                                {"double", "float64", 8}}};

PlyType parseType(const TextLine& line, std::string_view token) {
  const auto found = std::find_if(typeNames.begin(), typeNames.end(), [&](const TypeName& type) {
    return type.name == token || type.sizeName == token;
  });
  if (found == typeNames.end()) {
    line.fail(fmt::format(
        "type {}, expected char, uchar, short, ushort, int, uint, float or double", quote(token)));
  }
  return static_cast<PlyType>(found - typeNames.begin());
}

void requireTokens(const TextLine& line, std::size_t count, std::string_view form) {
  if (line.tokens.size() == count) return;
  line.fail(fmt::format("{} words, expected '{}'", line.tokens.size(), form));
}

PlyFormat parseFormat(const TextLine& line) {
  requireTokens(line, 3, "format FORMAT 1.0");
  constexpr std::array<std::string_view, 3> formats = {"ascii", "binary_little_endian",
                                                       "binary_big_endian"};
  const auto* const found = std::find(formats.begin(), formats.end(), line.tokens[1]);
  if (found == formats.end()) {
    line.fail(fmt::format("format {}, expected ascii, binary_little_endian or binary_big_endian",
                          quote(line.tokens[1])));
  }
  if (line.tokens[2] != "1.0") {
    line.fail(fmt::format("version {}, expected 1.0", quote(line.tokens[2])));
  }
  return static_cast<PlyFormat>(found - formats.begin());
}

PlyElement parseElement(const TextLine& line, const PlyHeader& header) {
  requireTokens(line, 3, "element NAME COUNT");
  const std::string name(line.tokens[1]);
  for (const PlyElement& other : header.elements) {
    if (other.name == name) line.fail(fmt::format("element {} for the second time", quote(name)));
  }
  const auto count = parseNumber<std::uint64_t>(line.tokens[2]);
  if (!count) line.fail(fmt::format("count {}, expected 0 or more", quote(line.tokens[2])));
  return {name, *count, {}};
}

void addProperty(const TextLine& line, PlyHeader& header) {
  if (header.elements.empty()) line.fail("property before any element");
  const bool list = line.tokens.size() > 1 && line.tokens[1] == "list";
  requireTokens(line, list ? 5 : 3,
                list ? "property list COUNT_TYPE TYPE NAME" : "property TYPE NAME");
  PlyProperty property{
      std::string(line.tokens.back()), parseType(line, line.tokens[line.tokens.size() - 2]), {}};
  if (list) {
    property.count = parseType(line, line.tokens[2]);
    if (*property.count >= PlyType::float32) line.fail("count of a list in a type of fractions");
  }
  PlyElement& element = header.elements.back();
  for (const PlyProperty& other : element.properties) {
    if (other.name == property.name) {
      line.fail(fmt::format("property {} of element {} for the second time", quote(other.name),
                            quote(element.name)));
    }
  }
  element.properties.push_back(std::move(property));
}

void requireProperties(const TextLine& line, const PlyHeader& header) {
  for (const PlyElement& element : header.elements) {
    if (element.count == 0 || !element.properties.empty()) continue;
    line.fail(fmt::format("element {} has {} rows without a property", quote(element.name),
                          element.count));
  }
}

/// Whether the first line ends with "\r" alone, and with it all lines of the header.
bool hasCarriageReturns(std::string_view bytes) {
  const std::string_view end = bytes.substr(std::min(bytes.find_first_of("\r\n"), bytes.size()));
  return end.starts_with('\r') && !end.starts_with("\r\n");
}

}  // namespace

std::size_t sizeOf(PlyType type) {
  return typeNames.at(static_cast<std::size_t>(type)).size;
}

std::string_view nameOf(PlyType type) {
  return typeNames.at(static_cast<std::size_t>(type)).name;
}

std::optional<std::size_t> PlyElement::find(std::string_view property, bool list) const {
  for (std::size_t i = 0; i < properties.size(); ++i) {
    if (properties[i].name == property && properties[i].count.has_value() == list) return i;
  }
  return std::nullopt;
}

PlyHeader readPlyHeader(const std::string& source, std::string_view bytes) {
  TextLines lines(source, bytes);
  TextLine line{source, 1, {}};
  const auto read = [&] {
    const auto next = lines.next();
    if (!next) line.fail("the header ends here, expected 'end_header'");
    line.number = next->number;
    line.tokens = next->tokens;
    return line.tokens.empty() ? std::string_view() : line.tokens.front();
  };
  if (!bytes.starts_with("ply") || read() != "ply" || line.tokens.size() != 1) {
    line.fail("not a PLY file, expected 'ply' on its first line");
  }
  PlyHeader header;
  if (read() != "format") line.fail("expected 'format FORMAT 1.0' after 'ply'");
  header.format = parseFormat(line);
  for (std::string_view keyword = read(); keyword != "end_header"; keyword = read()) {
    if (keyword == "element") {
      header.elements.push_back(parseElement(line, header));
    } else if (keyword == "property") {
      addProperty(line, header);
    } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info") {
      line.fail(
          fmt::format("{}, expected element, property, comment or end_header", quote(keyword)));
    }
  }
  requireProperties(line, header);
  header.bodyBegin = bytes.size() - lines.rest().size();
  // A "\n" after such a header is the first byte of a binary body.
  const bool takesTwo = bytes.substr(0, header.bodyBegin).ends_with("\r\n");
  if (header.format != PlyFormat::ascii && takesTwo && hasCarriageReturns(bytes)) {
    --header.bodyBegin;
  }
  header.bodyLine = line.number + 1;
  return header;
}

}  // namespace gnomon::surface
