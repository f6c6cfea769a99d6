// All that knows OpenImageIO: the module that image/image_module.h loads.

#include "image/image_module.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <system_error>
#include <utility>

namespace gnomon::image {
namespace {

OIIO::TypeDesc typeDesc(NumberType type) {
  return OIIO::TypeDesc(nameOf(type));
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
  facts.alpha = spec.alpha_channel;
  facts.z = spec.z_channel;
  facts.hasPlainAlpha = spec.get_int_attribute("oiio:UnassociatedAlpha", 0) != 0;
  facts.orientation = spec.get_int_attribute("Orientation", 1);
  facts.bytesAPixel = spec.pixel_bytes(true);
  facts.coding = std::string(spec.get_string_attribute("compression"));
  return facts;
}

class FileReader : public ImageReader {
 public:
  /// @param rowByRow  rows are asked for one by one, where the file has no tiles
  FileReader(std::unique_ptr<OIIO::ImageInput> file, bool rowByRow)
      : file_(std::move(file)), rowByRow_(rowByRow) {}

  [[nodiscard]] ImageFacts facts() const override { return factsOf(file_->spec()); }

  bool goTo(int part) override {
    row_ = 0;
    return file_->seek_subimage(part, 0);
  }

  void readRows(int rows, int first, int end, NumberType type, void* values) override {
    const OIIO::ImageSpec& spec = file_->spec();
    const std::size_t rowBytes = static_cast<std::size_t>(spec.width) *
                                 static_cast<std::size_t>(end - first) * typeDesc(type).size();
    auto* out = static_cast<std::uint8_t*>(values);
    if (spec.tile_width == 0) {
      const int step = rowByRow_ ? 1 : rows;
      for (int i = 0; i < rows; i += step, row_ += step) {
        readScanlines(row_, row_ + step, first, end, type,
                      out + static_cast<std::size_t>(i) * rowBytes);
      }
      return;
    }
    for (int i = 0; i < rows; ++i, ++row_, out += rowBytes) {
      const int inTile = row_ % spec.tile_height;
      if (inTile == 0) readTiles(row_, rowBytes, first, end, type);
      std::copy_n(tiles_.data() + static_cast<std::size_t>(inTile) * rowBytes, rowBytes, out);
    }
  }

 private:
  // Rows of the file are counted from the data window's own origin.
  void readScanlines(int top, int bottom, int first, int end, NumberType type, void* values) {
    const OIIO::ImageSpec& spec = file_->spec();
    check(file_->read_scanlines(file_->current_subimage(), 0, spec.y + top, spec.y + bottom, 0,
                                first, end, typeDesc(type), values));
  }

  /// The tiles beside each other whose first row is `top`.
  void readTiles(int top, std::size_t rowBytes, int first, int end, NumberType type) {
    const OIIO::ImageSpec& spec = file_->spec();
    const int rows = std::min(spec.tile_height, spec.height - top);
    tiles_.resize(rowBytes * static_cast<std::size_t>(rows));
    check(file_->read_tiles(file_->current_subimage(), 0, spec.x, spec.x + spec.width, spec.y + top,
                            spec.y + top + rows, spec.z, spec.z + 1, first, end, typeDesc(type),
                            tiles_.data()));
  }

  void check(bool isRead) {
    // The TIFF reader answers true for a file that is cut off, but keeps its error.
    if (!isRead || file_->has_error()) throw ImageError(file_->geterror());
  }

  std::unique_ptr<OIIO::ImageInput> file_;
  bool rowByRow_;
  int row_ = 0;  ///< the next one
  std::vector<std::uint8_t> tiles_;
};

/// OpenImageIO's name of a format's reader; PNG has one of its own, see png_reader.h.
const char* readerOf(ImageFormat format) {
  constexpr std::array names = {"openexr", "png", "tiff", "jpeg", "hdr",
                                "pnm",     "pnm", "bmp",  "targa"};
  return names.at(static_cast<std::size_t>(format));
}

std::unique_ptr<ImageReader> openFile(const std::filesystem::path& path, ImageFormat format) {
  // EXRs by OpenEXR's core library. The older reader takes a chunk that unpacks to less than its
  // rows, and fills up the rest with what its memory held.
  OIIO::attribute("openexr:core", 1);
  // What was written unmultiplied stays so: the library would round the product to a file's bits.
  OIIO::ImageSpec wishes;
  wishes.attribute("oiio:UnassociatedAlpha", 1);
  // ImageInput::open would try the readers of all other formats where this one fails.
  auto file = OIIO::ImageInput::create(readerOf(format));
  if (!file) throw ImageError(OIIO::geterror());
  // On several threads, or asked for several rows at once, the TIFF reader unpacks strips and tiles
  // by zlib itself, and takes one that holds less than its rows need: the rest is what its memory
  // held. libtiff, which it asks for single rows, does not.
  const bool isTiff = format == ImageFormat::tiff;
  if (isTiff) file->threads(1);
  OIIO::ImageSpec spec;
  if (!file->open(path.string(), spec, wishes)) throw ImageError(file->geterror());
  return std::make_unique<FileReader>(std::move(file), isTiff);
}

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

using Stream = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

/// An open file as a stream of its own.
Stream streamOf(int descriptor) {
  const int own = ::dup(descriptor);
  Stream stream(own < 0 ? nullptr : ::fdopen(own, "wb"), &std::fclose);
  if (!stream) throw ImageError(std::generic_category().message(errno));
  return stream;
}

/// @param target  where the bytes go
void encodeExr(OIIO::Filesystem::IOProxy& target, const ExrDescription& description,
               const ImageRows& rows) {
  auto file = OIIO::ImageOutput::create("openexr");
  if (!file) throw ImageError("no writer for EXR: " + OIIO::geterror());
  const auto check = [&](bool isDone) {
    if (!isDone) throw ImageError(file->geterror());
  };
  check(file->set_ioproxy(&target));
  check(file->open("written.exr", specOf(description)));
  for (int top = 0; top < description.height; top += rows.most) {
    const int bottom = std::min(top + rows.most, description.height);
    check(file->write_scanlines(top, bottom, 0, typeDesc(rows.type), rows.at(top, bottom - top)));
  }
  check(file->close());
}

std::string writeExrFile(std::optional<int> file, const ExrDescription& description,
                         const ImageRows& rows) {
  if (!file) {
    OIIO::Filesystem::IOVecOutput memory;
    encodeExr(memory, description, rows);
    return {memory.buffer().begin(), memory.buffer().end()};
  }
  const Stream stream = streamOf(*file);
  OIIO::Filesystem::IOFile target(stream.get(), OIIO::Filesystem::IOProxy::Write);
  encodeExr(target, description, rows);
  if (std::fflush(stream.get()) != 0) throw ImageError(std::generic_category().message(errno));
  return {};
}

}  // namespace
}  // namespace gnomon::image

/// Named by gnomon::imageModuleSymbol and gnomon::imageModuleVersionSymbol.
extern "C" {
extern const gnomon::image::ImageModule gnomonImageModule;
extern const char gnomonImageModuleVersion[];
}
const gnomon::image::ImageModule gnomonImageModule = {gnomon::image::openFile,
                                                      gnomon::image::writeExrFile};
const char gnomonImageModuleVersion[] = GNOMON_IMAGE_MODULE_VERSION;
