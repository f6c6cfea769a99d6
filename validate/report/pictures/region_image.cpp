#include "report/pictures/region_image.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
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

image::Image regionImage(const truth::Truth& truth) {
  image::Image image{truth.mask.width, truth.mask.height,
                     std::vector<std::uint8_t>(3 * truth.regions.size())};
  truth::Region last = truth::Region::none;
  image::Rgb colour = regionColour(last);
  for (std::size_t i = 0; i < truth.regions.size(); ++i) {
    if (truth.regions[i] != last) {
      last = truth.regions[i];
      colour = regionColour(last);
    }
    std::copy(colour.begin(), colour.end(), &image.rgb[3 * i]);
  }
  return image;
}

}  // namespace gnomon::report
