#include "export/npy_file.h"

#include <fmt/core.h>

#include <bit>

namespace gnomon::exporting {

std::string npyBytes(const image::ChannelImage& image) {
  static_assert(std::endian::native == std::endian::little);
  std::string header =
      fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}, {}, {}), }}",
                  image.height, image.width, image.channels.size());
  // Magic, version and the length's two bytes, then the header; all together in steps of 64.
  constexpr std::size_t before = 10;
  header.append(63 - (before + header.size()) % 64, ' ');
  header += '\n';
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(header.size() % 256);
  bytes += static_cast<char>(header.size() / 256);
  bytes += header;
  bytes.append(reinterpret_cast<const char*>(image.values.data()),
               image.values.size() * sizeof(float));
  return bytes;
}

}  // namespace gnomon::exporting
