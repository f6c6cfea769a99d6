#include "image_files/webp_encoder.h"

#include <webp/encode.h>

#include <cstddef>
#include <memory>

#include "image_files/image_error.h"

namespace gnomon {
namespace {

/// Takes the encoder's bytes, part by part.
int append(const std::uint8_t* data, std::size_t size, const WebPPicture* picture) {
  static_cast<std::string*>(picture->custom_ptr)->append(reinterpret_cast<const char*>(data), size);
  return 1;
}

}  // namespace

std::string webPBytes(int width, int height, const std::uint8_t* rgb, int quality) {
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
  picture.width = width;
  picture.height = height;
  picture.writer = append;
  picture.custom_ptr = &bytes;
  if (WebPPictureImportRGB(&picture, rgb, 3 * width) == 0 || WebPEncode(&config, &picture) == 0) {
    throw ImageError("libwebp: error " + std::to_string(picture.error_code));
  }
  return bytes;
}

}  // namespace gnomon
