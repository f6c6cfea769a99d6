#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "surface/readers/polygon_mesh.h"

namespace gnomon::surface {

// Shared by the sources of this component; no other component includes it.

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

// Shared by the sources of this component; no other component includes it.

/// The values of a PLY file one after the other, whatever it writes them in. Every value of a type
/// up to 32 bits is exact in a double.
class PlyBody {
 public:
  PlyBody(const std::string& source, std::string_view bytes, const PlyHeader& header);

  /// Begins the next row of an element; in an ASCII file it is the next line that is not blank.
  void beginRow(const PlyElement& element, std::uint64_t row);
  /// The row's next property: one value, or all of a list. Valid until the next call.
  const std::vector<double>& read(const PlyProperty& property);
  /// Refuses what an ASCII line holds beyond its row.
  void endRow();
  /// Refuses anything but blanks after the last row.
  void end();

  /// Line of the current row; 0 in a binary file.
  [[nodiscard]] int line() const { return line_ ? line_->number : 0; }
  /// @throws InputError "file:line: …", or "file: element face, row 3, byte 120: …"
  [[noreturn]] void fail(const std::string& message) const;

 private:
  double readValue(PlyType type, std::string_view name);
  double readText(PlyType type, std::string_view name);
  double readBinary(PlyType type, std::string_view name);
  [[nodiscard]] std::size_t valuesLeft(PlyType type) const;

  const std::string& source_;
  std::string_view bytes_;
  PlyFormat format_;
  std::size_t at_;  ///< of a binary file's next value
  TextLines lines_;
  std::optional<TextLine> line_;  ///< set by emplace: it holds a reference
  std::size_t token_ = 0;
  const PlyElement* element_ = nullptr;
  std::uint64_t row_ = 0;
  std::vector<double> values_;
};

}  // namespace gnomon::surface
