#include "report/pictures/displaced_image.h"

#include <array>
#include <cmath>

#include "common/parallel.h"

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

}  // namespace

image::Image displacedImage(int width, int height, const std::vector<float>& light) {
  image::Image image{width, height, std::vector<std::uint8_t>(albedo.size() * light.size(), 255)};
  parallelFor(
      0, light.size(),
      [&](std::size_t i) {
        if (light[i] < 0) return;
        for (std::size_t c = 0; c < albedo.size(); ++c) {
          image.rgb[albedo.size() * i + c] = shadedByte(albedo[c], light[i]);
        }
      },
      4096);
  return image;
}

}  // namespace gnomon::report
