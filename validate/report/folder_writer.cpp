#include "report/folder_writer.h"

#include <array>
#include <cmath>

#include "report/images.h"

namespace gnomon {
namespace {

// As shade.frag shades the base mesh, so that the pictures of a panel can be held side by side.
constexpr std::array albedo = {0.86F, 0.80F, 0.72F};
constexpr float ambient = 0.16F;
constexpr float gamma = 2.2F;

std::uint8_t shadedByte(float reflectance, float light) {
  const float linear = reflectance * (ambient + (1 - ambient) * light);
  return static_cast<std::uint8_t>(std::lround(255 * std::pow(linear, 1 / gamma)));
}

}  // namespace

void FolderWriter::mask(const std::string& path, const Mask& mask) {
  writePng(folder_ / path, maskImage(mask));
}

void FolderWriter::shaded(const std::string& path, int width, int height,
                          const std::vector<std::uint8_t>& rgb) {
  writePng(folder_ / path, Image{width, height, rgb});
}

void FolderWriter::difference(const std::string& path, const Mask& candidate, const Mask& truth) {
  writePng(folder_ / path, differenceImage(candidate, truth));
}

void FolderWriter::displaced(const std::string& path, int width, int height,
                             const std::vector<float>& light) {
  Image image{width, height, {}};
  image.rgb.reserve(3 * light.size());
  for (const float share : light) {
    for (const float reflectance : albedo) {
      image.rgb.push_back(share < 0 ? 255 : shadedByte(reflectance, share));
    }
  }
  writePng(folder_ / path, image);
}

}  // namespace gnomon
