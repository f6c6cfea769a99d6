#pragma once

namespace gnomon {

/// How the numbers of an image lie in a file or in memory.
enum class NumberType { uint8, uint32, half, float32 };

/// Its name in ImageFacts.
constexpr const char* nameOf(NumberType type) {
  switch (type) {
    case NumberType::uint8:
      return "uint8";
    case NumberType::uint32:
      return "uint";
    case NumberType::half:
      return "half";
    case NumberType::float32:
      return "float";
  }
  return "";
}

}  // namespace gnomon
