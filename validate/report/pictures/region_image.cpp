#include "report/pictures/region_image.h"

#include "common/error.h"

namespace gnomon {

Rgb regionColour(Region region) {
  switch (region) {
    case Region::none:
      return MaskColours::none;
    case Region::lit:
      return {255, 255, 255};
    case Region::attached:
      return {0, 63, 92};
    case Region::cast:
      return {26, 133, 255};
    case Region::distant:
      return {230, 97, 0};
    case Region::beyondTerminator:
      return {0, 0, 0};
  }
  throw InternalError("a region without a colour");
}

Image regionImage(const Truth& truth) {
  Image image{truth.mask.width, truth.mask.height, {}};
  image.rgb.reserve(3 * truth.regions.size());
  for (const Region region : truth.regions) {
    const Rgb colour = regionColour(region);
    image.rgb.insert(image.rgb.end(), colour.begin(), colour.end());
  }
  return image;
}

}  // namespace gnomon
