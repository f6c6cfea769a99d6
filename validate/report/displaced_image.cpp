#include "report/displaced_image.h"

#include <array>
#include <cmath>

namespace gnomon {
namespace {

// As shade.frag shades the base mesh.
constexpr std::array albedo = {0.86F, 0.80F, 0.72F};
constexpr float ambient = 0.16F;
constexpr float gamma = 2.2F;

std::uint8_t shadedByte(float reflectance, float light) {
  const float linear = reflectance * (ambient + (1 - ambient) * light);
  return static_cast<std::uint8_t>(std::lround(255 * std::pow(linear, 1 / gamma)));
}

}  // namespace

Image displacedImage(int width, int height, const std::vector<float>& light) {
  Image image{width, height, {}};
  image.rgb.reserve(3 * light.size());
  for (const float share : light) {
    for (const float reflectance : albedo) {
      image.rgb.push_back(share < 0 ? 255 : shadedByte(reflectance, share));
    }
  }
  return image;
}

}  // namespace gnomon
