// All that knows OpenImageIO: the module that image/image_module.h loads. TIFFs it leaves to
// libtiff.

#include "image/image_module.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <system_error>
#include <utility>

#include "tiff_reader.h"

namespace gnomon::image {
namespace {

OIIO::TypeDesc typeDesc(NumberType type) {
  return OIIO::TypeDesc(nameOf(type));
}

ImageFacts factsOf(const OIIO::ImageSpec& spec, ImageFormat format) {
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
  // A BMP's and a TGA's alpha stands beside the colours, whatever the library says; but for a TGA
  // of the kind that says otherwise.
  constexpr int multiplied = 4;
  facts.hasPlainAlpha =
      spec.get_int_attribute("oiio:UnassociatedAlpha", 0) != 0 || format == ImageFormat::bmp ||
      (format == ImageFormat::tga && spec.get_int_attribute("targa:alpha_type") != multiplied);
  facts.orientation = spec.get_int_attribute("Orientation", 1);
  // Only CMYK in its two forms has this name.
  if (!spec.get_string_attribute("jpeg:ColorSpace").empty()) facts.colourModel = "CMYK";
  facts.bytesAPixel = static_cast<double>(spec.pixel_bytes(true));
  facts.coding = std::string(spec.get_string_attribute("compression"));
  return facts;
}

class FileReader : public ImageReader {
 public:
  FileReader(std::unique_ptr<OIIO::ImageInput> file, ImageFormat format)
      : file_(std::move(file)), format_(format) {}

  [[nodiscard]] ImageFacts facts() const override { return factsOf(file_->spec(), format_); }

  bool goTo(int part) override {
    row_ = 0;
    return file_->seek_subimage(part, 0);
  }

  void readRows(int rows, int first, int end, float* values) override {
    const OIIO::ImageSpec& spec = file_->spec();
    const std::size_t step =
        static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(end - first);
    if (spec.tile_width == 0) {
      readChannels(row_, row_ + rows, first, end, values);
      row_ += rows;
      return;
    }
    for (int i = 0; i < rows; ++i, ++row_, values += step) {
      const int inTile = row_ % spec.tile_height;
      if (inTile == 0) {
        const int bottom = std::min(row_ + spec.tile_height, spec.height);
        tiles_.resize(step * static_cast<std::size_t>(bottom - row_));
        readChannels(row_, bottom, first, end, tiles_.data());
      }
      std::copy_n(tiles_.data() + static_cast<std::size_t>(inTile) * step, step, values);
    }
  }

 private:
  /// Rows [top, bottom), or the tiles that they fill: neighbouring channels of one type at a time,
  /// since the library would make shares of integers of 32 bits.
  void readChannels(int top, int bottom, int first, int end, float* values) {
    const OIIO::ImageSpec& spec = file_->spec();
    const auto isCount = [&](int c) { return spec.channelformat(c) == OIIO::TypeUInt; };
    for (int from = first, to = first; from < end; from = to) {
      while (to < end && isCount(to) == isCount(from)) ++to;
      float* const out = values + (from - first);
      read(top, bottom, from, to, isCount(from) ? NumberType::uint32 : NumberType::float32, out,
           static_cast<OIIO::stride_t>(sizeof(float)) * (end - first));
      if (!isCount(from)) continue;
      const auto pixels = static_cast<std::ptrdiff_t>(bottom - top) * spec.width;
      for (std::ptrdiff_t i = 0; i < pixels; ++i) {
        for (int c = 0; c < to - from; ++c) {
          float& number = out[i * (end - first) + c];
          number = static_cast<float>(std::bit_cast<std::uint32_t>(number));
        }
      }
    }
  }

  // Rows of the file are counted from the data window's own origin.
  void read(int top, int bottom, int first, int end, NumberType type, void* out,
            OIIO::stride_t pixelBytes) {
    const OIIO::ImageSpec& spec = file_->spec();
    const int part = file_->current_subimage();
    check(spec.tile_width == 0
              ? file_->read_scanlines(part, 0, spec.y + top, spec.y + bottom, 0, first, end,
                                      typeDesc(type), out, pixelBytes)
              : file_->read_tiles(part, 0, spec.x, spec.x + spec.width, spec.y + top,
                                  spec.y + bottom, spec.z, spec.z + 1, first, end, typeDesc(type),
                                  out, pixelBytes));
  }

  void check(bool isRead) {
    if (!isRead || file_->has_error()) throw ImageError(file_->geterror());
  }

  std::unique_ptr<OIIO::ImageInput> file_;
  ImageFormat format_;
  int row_ = 0;  ///< the next one
  std::vector<float> tiles_;
};

/// OpenImageIO's name of a format's reader; PNG and TIFF have their own, see png.h and
/// tiff_reader.h.
const char* readerOf(ImageFormat format) {
  constexpr std::array names = {"openexr", "png", "tiff", "jpeg", "hdr",
                                "pnm",     "pnm", "bmp",  "targa"};
  return names.at(static_cast<std::size_t>(format));
}

std::unique_ptr<ImageReader> openFile(const std::filesystem::path& path, ImageFormat format) {
  if (format == ImageFormat::tiff) return openTiff(path);
  // EXRs by OpenEXR's core library. The older reader takes a chunk that unpacks to less than its
  // rows, and fills up the rest with what its memory held.
  OIIO::attribute("openexr:core", 1);
  // What was written unmultiplied stays so: the library would round the product to a file's bits.
  OIIO::ImageSpec wishes;
  wishes.attribute("oiio:UnassociatedAlpha", 1);
  // ImageInput::open would try the readers of all other formats where this one fails.
  auto file = OIIO::ImageInput::create(readerOf(format));
  if (!file) throw ImageError(OIIO::geterror());
  OIIO::ImageSpec spec;
  if (!file->open(path.string(), spec, wishes)) throw ImageError(file->geterror());
  return std::make_unique<FileReader>(std::move(file), format);
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
    std::visit([&, &key = name](const auto& text) { spec.attribute(key, text); }, value);
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
