#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "surface/readers/ply_header.h"
#include "surface/readers/text_line.h"

// Shared by the sources of this component; no other component includes it.

namespace gnomon::surface {

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
