#include "report/pictures/displaced_image.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/parallel.h"
#include "image/images.h"

namespace gnomon::report {
namespace {

// As shade.frag shades the base mesh.
constexpr std::array albedo = {0.86F, 0.80F, 0.72F};
constexpr float ambient = 0.16F;
constexpr float gamma = 2.2F;

std::uint8_t shadedByte(float reflectance, float light) {
  const float linear = reflectance * (ambient + (1 - ambient) * light);
  return static_cast<std::uint8_t>(std::lround(255 * std::pow(linear, 1 / gamma)));
}

image::Rgb shaded(float light) {
  return {shadedByte(albedo[0], light), shadedByte(albedo[1], light), shadedByte(albedo[2], light)};
}

}  // namespace

image::Image displacedImage(int width, int height, const std::vector<float>& light) {
  image::Image image{width, height, std::vector<std::uint8_t>(albedo.size() * light.size(), 255)};
  const image::Rgb shadowed = shaded(0);
  parallelFor(
      0, light.size(),
      [&](std::size_t i) {
        if (light[i] < 0) return;
        const image::Rgb colour = light[i] == 0 ? shadowed : shaded(light[i]);
        std::copy(colour.begin(), colour.end(), &image.rgb[colour.size() * i]);
      },
      4096);
  return image;
}

}  // namespace gnomon::report
