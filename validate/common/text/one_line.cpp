#include "common/text/one_line.h"

#include "common/text/utf8.h"

namespace gnomon {

std::string oneLine(std::string_view text) {
  std::string line;
  line.reserve(text.size());
  while (!text.empty()) {
    const Utf8Character character = firstCharacter(text);
    if (!character.valid || turnsDirection(character.code)) {
      line += "\uFFFD";
    } else if (isControl(character.code)) {
      line += ' ';
    } else {
      line += text.substr(0, character.bytes);
    }
    text.remove_prefix(character.bytes);
  }
  return line;
}

}  // namespace gnomon
