#include "image/formats/webp_encoder.h"

#include <webp/encode.h>

#include <algorithm>
#include <cstddef>
#include <memory>

#include "image/image_error.h"

namespace gnomon {
namespace {

/// Takes the encoder's bytes, part by part.
int append(const std::uint8_t* data, std::size_t size, const WebPPicture* picture) {
  static_cast<std::string*>(picture->custom_ptr)->append(reinterpret_cast<const char*>(data), size);
  return 1;
}

void require(int succeeded, const WebPPicture& picture) {
  if (succeeded == 0) throw ImageError("libwebp: error " + std::to_string(picture.error_code));
}

void shrink(WebPPicture& picture, int longestSide) {
  const int longest = std::max(picture.width, picture.height);
  if (longest <= longestSide) return;
  const auto shrunk = [&](int side) {
    const auto length = static_cast<long>(side) * longestSide;
    return std::max(1, static_cast<int>((length + longest / 2) / longest));
  };
  require(WebPPictureRescale(&picture, shrunk(picture.width), shrunk(picture.height)), picture);
}

}  // namespace

std::string webPBytes(int width, int height, const std::uint8_t* rgb, int quality,
                      int longestSide) {
  WebPConfig config;
  WebPPicture picture;
  if (WebPConfigPreset(&config, WEBP_PRESET_DEFAULT, static_cast<float>(quality)) == 0 ||
      WebPPictureInit(&picture) == 0) {
    throw ImageError("libwebp is of another version than the one this was built for");
  }
  const std::unique_ptr<WebPPicture, decltype(&WebPPictureFree)> freed(&picture, WebPPictureFree);
  constexpr int littleEffort = 2;
  config.method = littleEffort;
  std::string bytes;
  picture.use_argb = 1;  // until it is encoded: shrinking keeps the colours' places
  picture.width = width;
  picture.height = height;
  picture.writer = append;
  picture.custom_ptr = &bytes;
  require(WebPPictureImportRGB(&picture, rgb, 3 * width), picture);
  shrink(picture, longestSide);
  require(WebPEncode(&config, &picture), picture);
  return bytes;
}

}  // namespace gnomon
