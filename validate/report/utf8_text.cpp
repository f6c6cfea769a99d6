#include "report/utf8_text.h"

#include <cstdint>

namespace gnomon {
namespace {

/// A character and the bytes that it took; `valid` is false for bytes that are no UTF-8.
struct Decoded {
  std::uint32_t code = 0;
  std::size_t bytes = 1;
  bool valid = false;
};

/// How many bytes a character takes by its first one, 0 for one that cannot begin any.
std::size_t lengthOf(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first < 0xE0) return 2;
  if (first >= 0xE0 && first < 0xF0) return 3;
  return first >= 0xF0 && first < 0xF5 ? 4 : 0;
}

Decoded decode(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::size_t length = lengthOf(byte(0));
  if (length == 0 || length > text.size()) return {};
  if (length == 1) return {byte(0), 1, true};
  std::uint32_t code = byte(0) & (0xFFU >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return {};
    code = (code << 6U) | (byte(i) & 0x3FU);
  }
  constexpr std::uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool valid =
      code >= least[length] && code <= 0x10FFFF && !(code >= 0xD800 && code < 0xE000);
  return valid ? Decoded{code, length, true} : Decoded{};
}

bool isXml(std::uint32_t code) {
  if (code < 0x20) return code == '\t' || code == '\n' || code == '\r';
  return code != 0xFFFE && code != 0xFFFF;
}

}  // namespace

std::string xmlText(std::string_view text) {
  std::string clean;
  clean.reserve(text.size());
  while (!text.empty()) {
    const Decoded character = decode(text);
    if (character.valid && isXml(character.code)) {
      clean += text.substr(0, character.bytes);
    } else {
      clean += "\uFFFD";
    }
    text.remove_prefix(character.bytes);
  }
  return clean;
}

}  // namespace gnomon
