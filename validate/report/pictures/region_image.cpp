#include "report/pictures/region_image.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "common/error.h"

namespace gnomon::report {

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
