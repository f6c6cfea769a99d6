#include "report/text/utf8_text.h"

#include "common/text/utf8.h"

namespace gnomon::report {
namespace {

bool isXml(std::uint32_t code) {
  if (isControl(code)) return code == '\t' || code == '\n' || code == '\r';
  return code != 0xFFFE && code != 0xFFFF;
}

}  // namespace

std::string xmlText(std::string_view text) {
  std::string clean;
  clean.reserve(text.size());
  while (!text.empty()) {
    const Utf8Character character = firstCharacter(text);
    const bool stays = character.valid && isXml(character.code) && !turnsDirection(character.code);
    clean += stays ? text.substr(0, character.bytes) : "\uFFFD";
    text.remove_prefix(character.bytes);
  }
  return clean;
}

}  // namespace gnomon::report
