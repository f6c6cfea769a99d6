#include "image/openimageio/module.h"

#include "image/openimageio/exr_writer.h"
#include "image/openimageio/file_reader.h"

namespace gnomon {
namespace {

class OpenImageIO : public ImageLibrary {
 public:
  [[nodiscard]] std::unique_ptr<ImageReader> open(const std::filesystem::path& path,
                                                  ImageFormat format) const override {
    return openImageFile(path, format);
  }

  [[nodiscard]] std::unique_ptr<ImageWriter> createExr(
      const std::filesystem::path& path, const ExrDescription& description) const override {
    return createExrFile(path, description);
  }

  [[nodiscard]] std::string exrBytes(const ExrDescription& description,
                                     const std::vector<float>& values) const override {
    return exrFileBytes(description, values);
  }
};

}  // namespace
}  // namespace gnomon

/// Named by gnomon::imageModuleSymbol.
extern "C" const gnomon::ImageLibrary* gnomonImageLibrary() {
  static const gnomon::OpenImageIO library;
  return &library;
}
