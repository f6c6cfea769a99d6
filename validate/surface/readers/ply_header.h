#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Shared by the sources of this component; no other component includes it.

namespace gnomon::surface {

enum class PlyFormat { ascii, littleEndian, bigEndian };

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Bytes of a value in a binary file.
std::size_t sizeOf(PlyType type);
/// As files spell it: "uchar".
std::string_view nameOf(PlyType type);

/// One property: a value, or where `count` is set a list, preceded by how many values it has.
struct PlyProperty {
  std::string name;
  PlyType type;
  std::optional<PlyType> count;
};

/// A table of the file: `count` rows with a value or list for every property.
struct PlyElement {
  std::string name;
  std::uint64_t count;
  std::vector<PlyProperty> properties;

  /// Place of the property among all; empty where there is none of this name, or it is a list where
  /// a value is asked for, or the other way round.
  [[nodiscard]] std::optional<std::size_t> find(std::string_view property, bool list) const;
};

/// What a PLY file (Turk 1994) says of itself.
struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
  std::size_t bodyBegin = 0;  ///< byte of the file after the header
  int bodyLine = 0;           ///< line of the file, from 1, where the header is followed by text
};

/// @param bytes  the whole file
/// @throws InputError naming the line: not a PLY, a keyword, format or type that there is none of,
///   a count that is none, an element or property named twice, a property before any element, an
///   element of rows without properties, no end of the header
PlyHeader readPlyHeader(const std::string& source, std::string_view bytes);

}  // namespace gnomon::surface
