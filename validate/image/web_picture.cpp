#include "image/web_picture.h"

#include <fmt/core.h>

#include <algorithm>

#include "common/error.h"
#include "common/text/base64.h"
#include "image/image_error.h"
#include "image/formats/webp_encoder.h"

namespace gnomon {

std::string dataAddress(std::string_view type, const std::string& bytes) {
  return fmt::format("data:{};base64,{}", type, base64(bytes));
}

std::string webPicture(const Image& image, int quality, int longestSide) {
  constexpr int longest = 16383;
  if (image.rgb.empty() || std::max(image.width, image.height) > longest) {
    throw InternalError(fmt::format("picture: {} x {} found, 1 to {} pixels a side expected",
                                    image.width, image.height, longest));
  }
  try {
    return webPBytes(image.width, image.height, image.rgb.data(), quality, longestSide);
  } catch (const ImageError& error) {
    throw InternalError(fmt::format("WebP cannot be written: {}", error.what()));
  }
}

}  // namespace gnomon
