#include "image/openimageio/exr_writer.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <utility>

#include "image/image_error.h"
#include "image/openimageio/type_desc.h"

namespace gnomon {
namespace {

OIIO::ImageSpec specOf(const ExrDescription& description) {
  OIIO::ImageSpec spec(description.width, description.height,
                       static_cast<int>(description.channels.size()),
                       typeDesc(description.numbers));
  spec.channelnames = description.channels;
  spec.alpha_channel = spec.z_channel = -1;
  spec.attribute("compression", "zip");
  // The writer would put in the time: the same numbers are the same bytes.
  spec.attribute("DateTime", "1970:01:01 00:00:00");
  for (const auto& [name, value] : description.attributes) {
    std::visit([&, &key = name](const auto& held) { spec.attribute(key, held); }, value);
  }
  return spec;
}

class ExrWriter : public ImageWriter {
 public:
  explicit ExrWriter(std::unique_ptr<OIIO::ImageOutput> file) : file_(std::move(file)) {}

  void writeRows(int top, int bottom, NumberType type, const void* values) override {
    if (!file_->write_scanlines(top, bottom, 0, typeDesc(type), values)) {
      throw ImageError(file_->geterror());
    }
  }

  void close() override {
    if (!file_->close()) throw ImageError(file_->geterror());
  }

 private:
  std::unique_ptr<OIIO::ImageOutput> file_;
};

std::unique_ptr<OIIO::ImageOutput> exrOutput() {
  auto file = OIIO::ImageOutput::create("openexr");
  if (!file) throw ImageError("no writer for EXR: " + OIIO::geterror());
  return file;
}

}  // namespace

std::unique_ptr<ImageWriter> createExrFile(const std::filesystem::path& path,
                                           const ExrDescription& description) {
  auto file = exrOutput();
  if (!file->open(path.string(), specOf(description))) throw ImageError(file->geterror());
  return std::make_unique<ExrWriter>(std::move(file));
}

std::string exrFileBytes(const ExrDescription& description, const std::vector<float>& values) {
  OIIO::Filesystem::IOVecOutput bytes;
  auto file = exrOutput();
  if (!file->set_ioproxy(&bytes) || !file->open("memory.exr", specOf(description)) ||
      !file->write_image(OIIO::TypeDesc::FLOAT, values.data()) || !file->close()) {
    throw ImageError(file->geterror());
  }
  return {bytes.buffer().begin(), bytes.buffer().end()};
}

}  // namespace gnomon
