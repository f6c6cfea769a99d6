#include "image/formats/bmp_header.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>

#include "image/image_reader.h"

namespace gnomon::image {

void requireSoundBmpHeader(const std::filesystem::path& path) {
  constexpr std::uint32_t fileHeader = 14;
  constexpr std::uint32_t coreHeader = 12;
  constexpr std::uint32_t infoHeader = 40;
  constexpr std::uint32_t longestHeader = 124;
  std::array<std::uint8_t, 54> start{};
  std::ifstream file(path, std::ios::binary);
  file.read(reinterpret_cast<char*>(start.data()), start.size());
  const auto held = static_cast<std::size_t>(file.gcount());
  const auto number = [&](std::size_t at, std::size_t size) {
    std::uint32_t value = 0;
    for (std::size_t i = size; i-- > 0;) value = value << 8 | start.at(at + i);
    return value;
  };
  const std::uint32_t header = number(fileHeader, 4);
  const bool isCore = header == coreHeader;
  if (held < fileHeader + coreHeader || (!isCore && header < infoHeader) ||
      header > longestHeader) {
    throw ImageError("its header is no BMP's");
  }
  const std::uint32_t bits = isCore ? number(24, 2) : number(28, 2);
  const std::uint32_t stated = isCore ? 0 : number(46, 4);
  constexpr std::uint32_t mostColours = 256;
  if (stated > mostColours) throw ImageError("its palette has more than 256 colours");
  const std::uint32_t colours = bits > 8 ? 0 : stated > 0 ? stated : 1U << bits;
  const std::uint64_t end = fileHeader + header + colours * (isCore ? 3U : 4U);
  if (end > std::filesystem::file_size(path)) throw ImageError("it ends in its header");
}

}  // namespace gnomon::image
