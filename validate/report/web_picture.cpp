#include "report/web_picture.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "common/error.h"

namespace gnomon {
namespace {

OIIO::ImageSpec specOf(int width, int height) {
  return {width, height, 3, OIIO::TypeDesc::UINT8};
}

}  // namespace

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
  OIIO::ImageSpec spec = specOf(image.width, image.height);
  spec["Compression"] = fmt::format("webp:{}", quality);
  const bool written = output->set_ioproxy(&memory) && output->open("picture.webp", spec) &&
                       output->write_image(OIIO::TypeDesc::UINT8, image.rgb.data()) &&
                       output->close();
  if (!written) throw InternalError("OpenImageIO: WebP cannot be written: " + output->geterror());
  return dataAddress("image/webp", std::string(bytes.begin(), bytes.end()));
}

Image shrunk(const Image& image, int side) {
  const int longest = std::max(image.width, image.height);
  if (longest <= side) return image;
  const double share = static_cast<double>(side) / longest;
  const auto scaled = [&](int length) {
    return std::max(1, static_cast<int>(std::lround(share * length)));
  };
  Image small{scaled(image.width), scaled(image.height), {}};
  small.rgb.resize(static_cast<std::size_t>(small.width) * static_cast<std::size_t>(small.height) *
                   3);
  // Around the picture's own pixels, which are only read; on this thread, since pictures are
  // embedded side by side.
  const OIIO::ImageBuf source(specOf(image.width, image.height),
                              const_cast<unsigned char*>(image.rgb.data()));
  const OIIO::ROI target(0, small.width, 0, small.height, 0, 1, 0, 3);
  constexpr int threads = 1;
  const bool resized = OIIO::ImageBufAlgo::resize(source, "lanczos3", 0, target, threads)
                           .get_pixels(target, OIIO::TypeDesc::UINT8, small.rgb.data());
  if (!resized)
    throw InternalError("OpenImageIO: a picture cannot be shrunk: " + source.geterror());
  return small;
}

}  // namespace gnomon
