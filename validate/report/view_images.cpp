#include "report/view_images.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "common/error.h"
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

image::Rgb regionColour(truth::Region region) {
  switch (region) {
    case truth::Region::none:
      return {image::MaskGreys::none, image::MaskGreys::none, image::MaskGreys::none};
    case truth::Region::lit:
      return {255, 255, 255};
    case truth::Region::attached:
      return {0, 63, 92};
    case truth::Region::cast:
      return {26, 133, 255};
    case truth::Region::distant:
      return {230, 97, 0};
    case truth::Region::global:
      return {212, 17, 89};
    case truth::Region::beyondTerminator:
      return {0, 0, 0};
  }
  throw InternalError("a region without a colour");
}

image::PaletteImage regionImage(const truth::Truth& truth) {
  const auto number = [](truth::Region region) { return static_cast<std::uint8_t>(region); };
  std::vector<image::Rgb> colours(truth::reportedRegions.size() + 1);
  colours.at(number(truth::Region::none)) = regionColour(truth::Region::none);
  for (const truth::Region region : truth::reportedRegions) {
    colours.at(number(region)) = regionColour(region);
  }
  image::PaletteImage image{truth.mask.width, truth.mask.height, std::move(colours),
                            std::vector<std::uint8_t>(truth.regions.size())};
  std::transform(truth.regions.begin(), truth.regions.end(), image.values.begin(), number);
  return image;
}

}  // namespace gnomon::report
