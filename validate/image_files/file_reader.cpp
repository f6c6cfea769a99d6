#include "image_files/file_reader.h"

#include <OpenEXR/ImfHeader.h>
#include <OpenImageIO/imageio.h>

#include <utility>

#include "image_files/image_error.h"
#include "image_files/type_desc.h"

namespace gnomon {
namespace {

ImageAttributes attributesOf(const OIIO::ImageSpec& spec) {
  ImageAttributes attributes;
  for (const OIIO::ParamValue& value : spec.extra_attribs) {
    const std::string name = value.name().string();
    if (value.type() == OIIO::TypeDesc::INT) attributes[name] = value.get_int();
    if (value.type() == OIIO::TypeDesc::FLOAT) attributes[name] = value.get_float();
    if (value.type() == OIIO::TypeDesc::STRING) attributes[name] = value.get_string();
  }
  return attributes;
}

ImageFacts factsOf(const OIIO::ImageSpec& spec) {
  ImageFacts facts;
  facts.data = {spec.x, spec.y, spec.width, spec.height};
  facts.display = {spec.full_x, spec.full_y, spec.full_width, spec.full_height};
  facts.depth = spec.depth;
  facts.isDeep = spec.deep;
  for (int c = 0; c < spec.nchannels; ++c) {
    facts.channels.emplace_back(spec.channel_name(c));
    facts.channelNumbers.emplace_back(spec.channelformat(c).c_str());
  }
  facts.numbers = spec.format.c_str();
  facts.alpha = spec.alpha_channel;
  facts.z = spec.z_channel;
  facts.hasPlainAlpha = spec.get_int_attribute("oiio:UnassociatedAlpha", 0) != 0;
  facts.orientation = spec.get_int_attribute("Orientation", 1);
  facts.pixelCount = spec.image_pixels();
  facts.bytesAPixel = spec.pixel_bytes(true);
  facts.attributes = attributesOf(spec);
  return facts;
}

class FileReader : public ImageReader {
 public:
  explicit FileReader(std::unique_ptr<OIIO::ImageInput> file) : file_(std::move(file)) {}

  [[nodiscard]] ImageFacts facts() const override { return factsOf(file_->spec()); }

  bool goTo(int part) override { return file_->seek_subimage(part, 0); }

  void read(int first, int end, NumberType type, void* values) override {
    const int part = file_->current_subimage();
    // The TIFF reader answers true for a file that is cut off, but keeps its error.
    if (!file_->read_image(part, 0, first, end, typeDesc(type), values) || file_->has_error()) {
      throw ImageError(file_->geterror());
    }
  }

  void readRows(int top, int bottom, NumberType type, void* values) override {
    const OIIO::ImageSpec& spec = file_->spec();
    // Scanlines are counted from the data window's own origin.
    if (!file_->read_scanlines(0, 0, spec.y + top, spec.y + bottom, 0, 0, spec.nchannels,
                               typeDesc(type), values)) {
      throw ImageError(file_->geterror());
    }
  }

 private:
  std::unique_ptr<OIIO::ImageInput> file_;
};

/// Has OpenEXR refuse images with a larger side, for this process. Without a limit it takes memory
/// for an index of all lines that a header promises, gigabytes for a damaged one of some bytes,
/// before anybody can ask for the size.
void limitExrSize() {
  constexpr int largestSide = 1 << 20;
  Imf::Header::setMaxImageSize(largestSide, largestSide);
}

}  // namespace

std::unique_ptr<ImageReader> openImageFile(const std::filesystem::path& path) {
  limitExrSize();
  // What was written unmultiplied stays so: the library would round the product to a file's bits.
  OIIO::ImageSpec wishes;
  wishes.attribute("oiio:UnassociatedAlpha", 1);
  auto file = OIIO::ImageInput::open(path.string(), &wishes);
  if (!file) throw ImageError(OIIO::geterror());
  return std::make_unique<FileReader>(std::move(file));
}

}  // namespace gnomon
