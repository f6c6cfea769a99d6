#include "surface/readers/ply_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "common/error.h"

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

namespace {

constexpr std::string_view blanks = " \t\r\n";

/// @param bytes  in the machine's own order
template <typename Number>
double decode(const char* bytes) {
  Number value{};
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<double>(value);
}

double decode(PlyType type, const char* bytes) {
  switch (type) {
    case PlyType::int8:
      return decode<std::int8_t>(bytes);
    case PlyType::uint8:
      return decode<std::uint8_t>(bytes);
    case PlyType::int16:
      return decode<std::int16_t>(bytes);
    case PlyType::uint16:
      return decode<std::uint16_t>(bytes);
    case PlyType::int32:
      return decode<std::int32_t>(bytes);
    case PlyType::uint32:
      return decode<std::uint32_t>(bytes);
    case PlyType::float32:
      return decode<float>(bytes);
    case PlyType::float64:
      return decode<double>(bytes);
  }
  throw InternalError("PLY: a type that there is none of");
}

/// Whether a whole number is one that a type can hold.
bool holds(PlyType type, std::int64_t value) {
  const auto bits = 8 * sizeOf(type);
  const bool isSigned = type == PlyType::int8 || type == PlyType::int16 || type == PlyType::int32;
  const std::int64_t values = std::int64_t{1} << bits;
  return isSigned ? value >= -values / 2 && value < values / 2 : value >= 0 && value < values;
}

}  // namespace

PlyBody::PlyBody(const std::string& source, std::string_view bytes, const PlyHeader& header)
    : source_(source),
      bytes_(bytes),
      format_(header.format),
      at_(header.bodyBegin),
      lines_(source, bytes.substr(header.bodyBegin), header.bodyLine) {}

void PlyBody::fail(const std::string& message) const {
  if (line_) line_->fail(message);
  throw InputError(fmt::format("{}: element {}, row {}, byte {}: {}", source_,
                               element_ ? quote(element_->name) : "none", row_, at_, message));
}

void PlyBody::beginRow(const PlyElement& element, std::uint64_t row) {
  element_ = &element;
  row_ = row;
  if (format_ != PlyFormat::ascii) return;
  token_ = 0;
  do {
    auto next = lines_.next();
    if (!next) {
      throw InputError(fmt::format("{}: ends at row {} of element {}, expected {} rows", source_,
                                   row, quote(element.name), element.count));
    }
    line_.emplace(*next);
  } while (line_->tokens.empty());
}

void PlyBody::endRow() {
  if (!line_ || token_ == line_->tokens.size()) return;
  fail(fmt::format("{} values more than element {} has properties", line_->tokens.size() - token_,
                   quote(element_->name)));
}

void PlyBody::end() {
  const std::string_view rest =
      format_ == PlyFormat::ascii ? lines_.rest() : bytes_.substr(std::min(at_, bytes_.size()));
  if (rest.find_first_not_of(blanks) == std::string_view::npos) return;
  throw InputError(
      fmt::format("{}: {} bytes after the last row that the header counts", source_, rest.size()));
}

const std::vector<double>& PlyBody::read(const PlyProperty& property) {
  values_.clear();
  std::size_t count = 1;
  if (property.count) {
    const double length = readValue(*property.count, property.name);
    // Checked before anything is read: a wrong count may be of any size.
    const std::size_t left = valuesLeft(property.type);
    if (!(length >= 0) || length > static_cast<double>(left)) {
      fail(fmt::format("list {} of {} values, where the {} holds {} more", quote(property.name),
                       length, line_ ? "line" : "file", left));
    }
    count = static_cast<std::size_t>(length);
  }
  for (std::size_t i = 0; i < count; ++i)
    values_.push_back(readValue(property.type, property.name));
  return values_;
}

std::size_t PlyBody::valuesLeft(PlyType type) const {
  return line_ ? line_->tokens.size() - token_ : (bytes_.size() - at_) / sizeOf(type);
}

double PlyBody::readValue(PlyType type, std::string_view name) {
  return line_ ? readText(type, name) : readBinary(type, name);
}

double PlyBody::readText(PlyType type, std::string_view name) {
  if (token_ == line_->tokens.size()) {
    fail(fmt::format("{} values, but none for property {} of element {}", token_, quote(name),
                     quote(element_->name)));
  }
  const std::string_view token = line_->tokens[token_++];
  if (type == PlyType::float32 || type == PlyType::float64) {
    // An infinity or NaN may stand where nobody needs the value.
    const auto value = parseNumber<double>(token);
    if (!value) fail(fmt::format("{} is {}, expected a number", quote(name), quote(token)));
    return *value;
  }
  const auto value = parseNumber<std::int64_t>(token);
  if (!value || !holds(type, *value)) {
    fail(fmt::format("{} is {}, expected an integer of type {}", quote(name), quote(token),
                     nameOf(type)));
  }
  return static_cast<double>(*value);
}

double PlyBody::readBinary(PlyType type, std::string_view name) {
  const std::size_t size = sizeOf(type);
  if (valuesLeft(type) == 0) fail(fmt::format("the file ends within {}", quote(name)));
  std::array<char, 8> bytes{};
  std::copy_n(bytes_.data() + at_, size, bytes.data());
  const bool bigEndian = format_ == PlyFormat::bigEndian;
  if (bigEndian != (std::endian::native == std::endian::big)) {
    std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
  }
  at_ += size;
  return decode(type, bytes.data());
}

}  // namespace gnomon::surface
