#include "common/one_line.h"

#include <algorithm>

namespace gnomon {

std::string oneLine(std::string_view text) {
  std::string line(text);
  std::replace_if(
      line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) < 32; }, ' ');
  return line;
}

}  // namespace gnomon
