#include "surface/readers/ply_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "common/error.h"

namespace gnomon::surface {
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
