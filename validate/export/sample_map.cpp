#include "export/sample_map.h"

#include <fmt/core.h>

#include <bit>
#include <map>
#include <utility>

namespace gnomon::exporting {

namespace {

std::string withEnding(const std::string& mapFile, const char* ending) {
  return mapFile.substr(0, mapFile.rfind('.')) + ending;
}

}  // namespace

std::string npyName(const std::string& mapFile) {
  return withEnding(mapFile, ".npy");
}

std::string layersName(const std::string& mapFile) {
  return withEnding(mapFile, "_layers.exr");
}

void writeSampleMap(report::RunFolder& folder, const std::string& mapFile,
                    image::ChannelImage map) {
  image::writeExr(folder.newFile(mapFile), map);
  folder.write(npyName(mapFile), npyBytes(map));
  const std::map<std::string, std::string> inLayers = {
      {"face", "place.X"}, {"s", "place.Y"}, {"t", "place.Z"}, {"weight", "texel.Z"}};
  for (std::string& channel : map.channels) {
    const auto other = inLayers.find(channel);
    if (other != inLayers.end()) channel = other->second;
  }
  image::writeExr(folder.newFile(layersName(mapFile)), map);
}

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
