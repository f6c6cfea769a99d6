#include "report/pictures/region_image.h"

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
  image::Image image{truth.mask.width, truth.mask.height, {}};
  image.rgb.reserve(3 * truth.regions.size());
  for (const truth::Region region : truth.regions) {
    const image::Rgb colour = regionColour(region);
    image.rgb.insert(image.rgb.end(), colour.begin(), colour.end());
  }
  return image;
}

}  // namespace gnomon::report
