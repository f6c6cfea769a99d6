#include "image/web_picture.h"

#include <fmt/core.h>
#include <webp/encode.h>

#include <algorithm>
#include <memory>

#include "common/error.h"
#include "common/text/base64.h"

namespace gnomon::image {
namespace {

void require(bool succeeded, const WebPPicture& picture) {
  if (succeeded) return;
  throw InternalError(fmt::format("a WebP of {} x {} pixels cannot be written: error {} of libwebp",
                                  picture.width, picture.height,
                                  static_cast<int>(picture.error_code)));
}

void shrink(WebPPicture& picture, int longestSide) {
  const int longest = std::max(picture.width, picture.height);
  if (longest <= longestSide) return;
  const auto shrunk = [&](int side) {
    const auto length = static_cast<long>(side) * longestSide;
    return std::max(1, static_cast<int>((length + longest / 2) / longest));
  };
  const int width = shrunk(picture.width);
  require(WebPPictureRescale(&picture, width, shrunk(picture.height)) != 0, picture);
}

}  // namespace

std::string dataAddress(std::string_view type, const std::string& bytes) {
  return fmt::format("data:{};base64,{}", type, base64(bytes));
}

std::string webPicture(const Image& image, int quality, int longestSide) {
  WebPConfig config;
  WebPPicture picture;
  if (WebPConfigPreset(&config, WEBP_PRESET_DEFAULT, static_cast<float>(quality)) == 0 ||
      WebPPictureInit(&picture) == 0) {
    throw InternalError("libwebp is of another version than the one this was built for");
  }
  WebPMemoryWriter writer;
  WebPMemoryWriterInit(&writer);
  const std::unique_ptr<WebPMemoryWriter, decltype(&WebPMemoryWriterClear)> cleared(
      &writer, WebPMemoryWriterClear);
  const std::unique_ptr<WebPPicture, decltype(&WebPPictureFree)> freed(&picture, WebPPictureFree);
  constexpr int littleEffort = 2;
  config.method = littleEffort;
  // What is shrunk first keeps its colours' places until it is encoded.
  picture.use_argb = std::max(image.width, image.height) > longestSide ? 1 : 0;
  picture.width = image.width;
  picture.height = image.height;
  picture.writer = WebPMemoryWrite;
  picture.custom_ptr = &writer;
  require(!image.rgb.empty(), picture);
  require(WebPPictureImportRGB(&picture, image.rgb.data(), 3 * image.width) != 0, picture);
  shrink(picture, longestSide);
  require(WebPEncode(&config, &picture) != 0, picture);
  return {reinterpret_cast<const char*>(writer.mem), writer.size};
}

}  // namespace gnomon::image
