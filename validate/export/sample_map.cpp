#include "export/sample_map.h"

#include <map>
#include <utility>

#include "export/npy_file.h"

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

}  // namespace gnomon::exporting
