#include "report/web_picture.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>
#include <fmt/core.h>

#include <algorithm>
#include <memory>

#include "common/error.h"

namespace gnomon {

std::string dataAddress(std::string_view type, const std::string& bytes) {
  return fmt::format("data:{};base64,{}", type, OIIO::Strutil::base64_encode(bytes));
}

std::string webPicture(const Image& image, int quality) {
  constexpr int longest = 16383;
  if (image.rgb.empty() || std::max(image.width, image.height) > longest) {
    throw InternalError(fmt::format("picture: {} x {} found, 1 to {} pixels a side expected",
                                    image.width, image.height, longest));
  }
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("webp");
  if (!output) throw InternalError("OpenImageIO: no writer for WebP: " + OIIO::geterror());
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeDesc::UINT8);
  spec["Compression"] = fmt::format("webp:{}", quality);
  const bool written = output->set_ioproxy(&memory) && output->open("picture.webp", spec) &&
                       output->write_image(OIIO::TypeDesc::UINT8, image.rgb.data()) &&
                       output->close();
  if (!written) throw InternalError("OpenImageIO: WebP cannot be written: " + output->geterror());
  return dataAddress("image/webp", std::string(bytes.begin(), bytes.end()));
}

}  // namespace gnomon
