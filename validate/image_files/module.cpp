#include "image_files/module.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/filter.h>
#include <OpenImageIO/imageio.h>

#include "image_files/exr_writer.h"
#include "image_files/file_reader.h"
#include "image_files/image_error.h"
#include "image_files/webp_encoder.h"

namespace gnomon {
namespace {

/// A picture as the bytes of a file.
std::string encoded(const std::string& format, OIIO::ImageSpec spec, const std::uint8_t* rgb) {
  const auto output = OIIO::ImageOutput::create(format);
  if (!output) throw ImageError("no writer: " + OIIO::geterror());
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const bool written = output->set_ioproxy(&memory) && output->open("picture." + format, spec) &&
                       output->write_image(OIIO::TypeDesc::UINT8, rgb) && output->close();
  if (!written) throw ImageError(output->geterror());
  return {bytes.begin(), bytes.end()};
}

class OpenImageIO : public ImageLibrary {
 public:
  [[nodiscard]] std::unique_ptr<ImageReader> open(
      const std::filesystem::path& path) const override {
    return openImageFile(path);
  }

  [[nodiscard]] std::unique_ptr<ImageWriter> createExr(
      const std::filesystem::path& path, const ExrDescription& description) const override {
    return createExrFile(path, description);
  }

  [[nodiscard]] std::string png(int width, int height, const std::uint8_t* rgb) const override {
    // Rows less the one above: as small as the filter that libpng chooses for each, in two thirds
    // of the time.
    constexpr int pngFilterUp = 0x20;
    OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
    spec.attribute("png:filter", pngFilterUp);
    return encoded("png", spec, rgb);
  }

  [[nodiscard]] std::string webp(int width, int height, const std::uint8_t* rgb,
                                 int quality) const override {
    return webPBytes(width, height, rgb, quality);
  }

  [[nodiscard]] std::vector<float> lanczos3(float width,
                                            const std::vector<float>& distances) const override {
    const auto destroy = [](OIIO::Filter2D* filter) { OIIO::Filter2D::destroy(filter); };
    const std::unique_ptr<OIIO::Filter2D, decltype(destroy)> filter(
        OIIO::Filter2D::create("lanczos3", width, width), destroy);
    if (!filter) throw ImageError("no filter lanczos3");
    std::vector<float> weights;
    weights.reserve(distances.size());
    for (const float distance : distances) weights.push_back(filter->xfilt(distance));
    return weights;
  }
};

}  // namespace
}  // namespace gnomon

/// Named by gnomon::imageModuleSymbol.
extern "C" const gnomon::ImageLibrary* gnomonImageLibrary() {
  static const gnomon::OpenImageIO library;
  return &library;
}
