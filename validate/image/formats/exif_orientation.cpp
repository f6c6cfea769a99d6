#include "image/formats/exif_orientation.h"

#include <cstddef>

namespace gnomon::image {
namespace {

/// Numbers of a TIFF structure; 0 past its end.
class Numbers {
 public:
  explicit Numbers(std::span<const std::uint8_t> bytes)
      : bytes_(bytes), isBig_(!bytes.empty() && bytes[0] == 'M') {}

  [[nodiscard]] std::size_t two(std::size_t at) const { return number(at, 2); }
  [[nodiscard]] std::size_t four(std::size_t at) const { return number(at, 4); }

 private:
  [[nodiscard]] std::size_t number(std::size_t at, std::size_t count) const {
    if (at > bytes_.size() || bytes_.size() - at < count) return 0;
    std::size_t value = 0;
    for (std::size_t i = 0; i < count; ++i) {
      value = value << 8 | bytes_[isBig_ ? at + i : at + count - 1 - i];
    }
    return value;
  }

  std::span<const std::uint8_t> bytes_;
  bool isBig_;
};

}  // namespace

int exifOrientation(std::span<const std::uint8_t> exif) {
  constexpr std::size_t orientation = 274;
  constexpr std::size_t entryBytes = 12;
  const Numbers numbers(exif);
  const std::size_t directory = numbers.four(4);
  const std::size_t entries = numbers.two(directory);
  for (std::size_t i = 0; i < entries; ++i) {
    const std::size_t entry = directory + 2 + i * entryBytes;
    if (numbers.two(entry) != orientation) continue;
    const std::size_t value = numbers.two(entry + 8);
    return value >= 1 && value <= 8 ? static_cast<int>(value) : 1;
  }
  return 1;
}

}  // namespace gnomon::image
