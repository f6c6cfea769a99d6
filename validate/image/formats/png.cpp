#include "image/formats/png.h"

#include <png.h>
#include <spng.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <new>
#include <span>
#include <utility>
#include <vector>

#include "common/error.h"
#include "common/raw_vector.h"
#include "image/formats/picture_headers.h"
#include "image/images.h"

namespace gnomon::image {

namespace {

constexpr double unpacked = 2;
constexpr double runs = 256;
constexpr double packed = 3000;
constexpr double unbounded = std::numeric_limits<double>::infinity();

double mostInExr(const std::string& coding) {
  if (coding == "none") return unpacked;
  if (coding == "rle") return runs;
  // A block of DWA's may hold nothing but the fact that it is flat.
  return coding.starts_with("dwa") ? unbounded : packed;
}

double mostInTiff(const std::string& coding) {
  if (coding == "none") return unpacked;
  if (coding == "packbits") return runs;
  // A fax holds a whole white row in a bit.
  return coding == "zip" || coding == "lzw" || coding == "jpeg" ? packed : unbounded;
}

}  // namespace

double mostBytesAByteHolds(ImageFormat format, const std::string& coding) {
  switch (format) {
    case ImageFormat::exr:
      return mostInExr(coding);
    case ImageFormat::tiff:
      return mostInTiff(coding);
    case ImageFormat::png:
    case ImageFormat::jpeg:
      return packed;
    case ImageFormat::hdr:
    case ImageFormat::tga:
    case ImageFormat::bmp:
      return runs;
    case ImageFormat::pnm:
    case ImageFormat::pfm:
      // Eight pixels of a bitmap are a byte of the file, and eight of the reader.
      return 8 * unpacked;
  }
  return unbounded;
}

namespace {

constexpr std::size_t channels = 3;

/// libpng's two structures, and what it writes and complains of.
struct Writer {
  Writer() {
    png = png_create_write_struct(PNG_LIBPNG_VER_STRING, this, fail, warn);
    if (png) info = png_create_info_struct(png);
    if (!info) {
      png_destroy_write_struct(&png, nullptr);
      throw std::bad_alloc();
    }
    png_set_write_fn(png, this, append, nullptr);
  }
  ~Writer() { png_destroy_write_struct(&png, &info); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  png_structp png = nullptr;
  png_infop info = nullptr;
  std::string bytes;
  const char* message = "";

 private:
  static void append(png_structp png, png_bytep data, std::size_t count) {
    auto* writer = static_cast<Writer*>(png_get_io_ptr(png));
    bool fits = true;
    try {
      writer->bytes.append(reinterpret_cast<const char*>(data), count);
    } catch (const std::bad_alloc&) {
      fits = false;
    }
    if (!fits) png_error(png, "no memory");  // it does not return, and must not out of a handler
  }
  [[noreturn]] static void fail(png_structp png, png_const_charp message) {
    static_cast<Writer*>(png_get_error_ptr(png))->message = message;
    png_longjmp(png, 1);
  }
  static void warn(png_structp, png_const_charp) {}
};

/// Every row less the one above is as small as with a filter chosen row by row, sooner. zlib's
/// search for runs alone is made for pictures: those here take half the time that they take at its
/// usual effort, and on the whole a tenth more bytes.
void choosePacking(png_structp png) {
  constexpr int mostMemory = 9;
  constexpr std::size_t oneChunk = 1U << 20;  // or few
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_UP);
  png_set_compression_strategy(png, Z_RLE);
  png_set_compression_mem_level(png, mostMemory);
  png_set_compression_buffer_size(png, oneChunk);
}

/// Rows of a picture as a PNG has them: values of 16 bits with the higher byte first.
struct Rows {
  int width;
  int height;
  int bits;
  int colour;  ///< PNG_COLOR_TYPE_…
  std::size_t rowBytes;
  const std::uint8_t* bytes;
  std::span<const Rgb> palette = {};  ///< of PNG_COLOR_TYPE_PALETTE
};

void requireWhole(int width, int height, std::size_t channelCount, std::size_t values) {
  const std::size_t row = channelCount * static_cast<std::size_t>(std::max(width, 0));
  if (width >= 1 && height >= 1 && values == row * static_cast<std::size_t>(height)) return;
  throw InternalError("PNG of " + std::to_string(width) + " x " + std::to_string(height) +
                      " pixels: " + std::to_string(values) + " values found");
}

std::vector<png_color> paletteOf(std::span<const Rgb> colours) {
  std::vector<png_color> palette;
  for (const Rgb& colour : colours) palette.push_back({colour[0], colour[1], colour[2]});
  return palette;
}

std::string encoded(const Rows& rows) {
  Writer writer;
  const std::vector<png_color> palette = paletteOf(rows.palette);
  // libpng comes back here where it fails. Nothing below has a destructor that would be left out.
  if (setjmp(png_jmpbuf(writer.png)) != 0) {
    throw InternalError("PNG of " + std::to_string(rows.width) + " x " +
                        std::to_string(rows.height) + " pixels: " + writer.message);
  }
  png_set_IHDR(writer.png, writer.info, static_cast<png_uint_32>(rows.width),
               static_cast<png_uint_32>(rows.height), rows.bits, rows.colour, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (!palette.empty()) {
    png_set_PLTE(writer.png, writer.info, palette.data(), static_cast<int>(palette.size()));
  }
  choosePacking(writer.png);
  png_write_info(writer.png, writer.info);
  for (std::size_t y = 0; y < static_cast<std::size_t>(rows.height); ++y) {
    png_write_row(writer.png, rows.bytes + y * rows.rowBytes);
  }
  png_write_end(writer.png, writer.info);
  return std::move(writer.bytes);
}

}  // namespace

std::string pngOf(const Image& image) {
  requireWhole(image.width, image.height, channels, image.rgb.size());
  return encoded({image.width, image.height, 8, PNG_COLOR_TYPE_RGB,
                  channels * static_cast<std::size_t>(image.width), image.rgb.data()});
}

std::string pngOf(const ByteImage& image) {
  requireWhole(image.width, image.height, 1, image.values.size());
  return encoded({image.width, image.height, 8, PNG_COLOR_TYPE_GRAY,
                  static_cast<std::size_t>(image.width), image.values.data()});
}

std::string pngOf(const PaletteImage& image) {
  requireWhole(image.width, image.height, 1, image.values.size());
  if (image.colours.empty() || image.colours.size() > 256) {
    throw InternalError("PNG: a palette of " + std::to_string(image.colours.size()) +
                        " colours found, 1 to 256 expected");
  }
  return encoded({image.width, image.height, 8, PNG_COLOR_TYPE_PALETTE,
                  static_cast<std::size_t>(image.width), image.values.data(), image.colours});
}

std::string pngOf(const GreyImage& image) {
  requireWhole(image.width, image.height, 1, image.values.size());
  std::vector<std::uint8_t> bytes;
  bytes.reserve(2 * image.values.size());
  for (const std::uint16_t value : image.values) {
    bytes.push_back(static_cast<std::uint8_t>(value >> 8));
    bytes.push_back(static_cast<std::uint8_t>(value & 255));
  }
  return encoded({image.width, image.height, 16, PNG_COLOR_TYPE_GRAY,
                  2 * static_cast<std::size_t>(image.width), bytes.data()});
}

namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
struct FreeContext {
  void operator()(spng_ctx* context) const { spng_ctx_free(context); }
};

void check(int status) {
  if (status != SPNG_OK) throw ImageError(spng_strerror(status));
}

/// A PNG's pixels as they are asked of libspng: palettes and fewer than 8 bits are unfolded, a
/// transparent colour is alpha.
struct Layout {
  int channels = 1;
  int bits = 8;
  int format = SPNG_FMT_PNG;

  [[nodiscard]] std::size_t pixelBytes() const {
    return static_cast<std::size_t>(channels * bits / 8);
  }
};

Layout layoutOf(const spng_ihdr& header, bool hasTransparentColour) {
  const int type = header.color_type;
  const bool isGrey = type == SPNG_COLOR_TYPE_GRAYSCALE || type == SPNG_COLOR_TYPE_GRAYSCALE_ALPHA;
  const bool hasAlpha = hasTransparentColour || type == SPNG_COLOR_TYPE_GRAYSCALE_ALPHA ||
                        type == SPNG_COLOR_TYPE_TRUECOLOR_ALPHA;
  Layout layout;
  layout.channels = (isGrey ? 1 : 3) + (hasAlpha ? 1 : 0);
  layout.bits = header.bit_depth == 16 ? 16 : 8;
  const bool isPlain =
      header.bit_depth >= 8 && type != SPNG_COLOR_TYPE_INDEXED && !hasTransparentColour;
  if (isPlain) return layout;
  if (layout.bits == 16) {
    layout.format = isGrey ? SPNG_FMT_GA16 : SPNG_FMT_RGBA16;
  } else if (isGrey) {
    layout.format = hasAlpha ? SPNG_FMT_GA8 : SPNG_FMT_G8;
  } else {
    layout.format = hasAlpha ? SPNG_FMT_RGBA8 : SPNG_FMT_RGB8;
  }
  return layout;
}

template <typename Number>
float* toShares(const std::uint8_t* pixel, std::size_t first, std::size_t end, float* out) {
  for (std::size_t c = first; c < end; ++c) {
    Number value = 0;
    std::memcpy(&value, pixel + c * sizeof value, sizeof value);
    *out++ = numberOf(value, std::numeric_limits<Number>::max());
  }
  return out;
}

class PngReader : public ImageReader {
 public:
  explicit PngReader(std::filesystem::path path) : path_(std::move(path)) {
    open();
    spng_trns transparent{};
    layout_ = layoutOf(header_, spng_get_trns(context_.get(), &transparent) == SPNG_OK);
    setFacts();
  }

  [[nodiscard]] ImageFacts facts() const override { return facts_; }

  bool goTo(int part) override {
    if (part != 0) return false;
    if (row_ > 0) open();
    return true;
  }

  void readRows(int rows, int first, int end, float* values) override {
    const auto from = static_cast<std::size_t>(first);
    const auto to = static_cast<std::size_t>(end);
    float* out = values;
    for (int i = 0; i < rows; ++i) {
      const std::uint8_t* pixel = nextRow();
      for (std::uint32_t x = 0; x < header_.width; ++x, pixel += layout_.pixelBytes()) {
        out = layout_.bits == 16 ? toShares<std::uint16_t>(pixel, from, to, out)
                                 : toShares<std::uint8_t>(pixel, from, to, out);
      }
    }
  }

 private:
  /// Begins anew, up to the pixels. Nothing of them is decoded yet: the header may state any size.
  void open() {
    file_.reset(std::fopen(path_.c_str(), "rb"));
    if (!file_) throw ImageError(std::string("cannot be opened: ") + std::strerror(errno));
    context_.reset(spng_ctx_new(0));
    if (!context_) throw std::bad_alloc();
    row_ = 0;
    constexpr std::size_t longestChunk = 8'000'000;  // of texts and profiles, unpacked
    check(spng_set_chunk_limits(context_.get(), longestChunk, 2 * longestChunk));
    check(spng_set_png_file(context_.get(), file_.get()));
    check(spng_get_ihdr(context_.get(), &header_));
  }

  void setFacts() {
    constexpr const char* names[] = {"R", "G", "B"};
    const bool isGrey = layout_.channels < 3;
    if (isGrey) facts_.channels = {"Y"};
    if (!isGrey) facts_.channels.assign(std::begin(names), std::end(names));
    if (layout_.channels % 2 == 0) facts_.channels.emplace_back("A");
    facts_.data =
        facts_.display = {0, 0, static_cast<int>(header_.width), static_cast<int>(header_.height)};
    facts_.channelNumbers.assign(facts_.channels.size(), layout_.bits == 16 ? "uint16" : "uint8");
    facts_.alpha = facts_.channel("A");
    facts_.hasPlainAlpha = facts_.alpha >= 0;
    facts_.bytesAPixel = static_cast<double>(layout_.pixelBytes());
    facts_.orientation = orientation();
  }

  [[nodiscard]] int orientation() const {
    spng_exif exif{};
    if (spng_get_exif(context_.get(), &exif) != SPNG_OK) return 1;
    return exifOrientation({reinterpret_cast<const std::uint8_t*>(exif.data), exif.length});
  }

  const std::uint8_t* nextRow() {
    const std::size_t size = header_.width * layout_.pixelBytes();
    const bool whole = header_.interlace_method != SPNG_INTERLACE_NONE;
    if (row_ == 0) start(size * (whole ? header_.height : 1), whole);
    const bool isLast = ++row_ == header_.height;
    if (!whole) {
      const int status = spng_decode_row(context_.get(), bytes_.data(), size);
      check(isLast && status == SPNG_EOI ? SPNG_OK : status);
    }
    if (isLast) readEnd();
    return bytes_.data() + (whole ? size * (row_ - 1) : 0);
  }

  /// What follows the pixels: a file that ends before its end is damaged. libspng 0.7 answers OK
  /// where the last chunk's checksum is missing.
  void readEnd() {
    check(spng_decode_chunks(context_.get()));
    // Exif may stand behind the pixels.
    if (orientation() != facts_.orientation) {
      throw ImageError("its Orientation is " + std::to_string(orientation()) +
                       ", upright pixels (1) expected: turn the picture");
    }
    check(std::feof(file_.get()) == 0 ? SPNG_OK : SPNG_IO_EOF);
  }

  /// @param whole  the picture is interlaced: only the last of seven passes has whole rows
  void start(std::size_t size, bool whole) {
    bytes_ = RawVector<std::uint8_t>(size);
    check(spng_decode_image(context_.get(), whole ? bytes_.data() : nullptr, whole ? size : 0,
                            layout_.format,
                            SPNG_DECODE_TRNS | (whole ? 0 : SPNG_DECODE_PROGRESSIVE)));
  }

  std::filesystem::path path_;
  std::unique_ptr<std::FILE, CloseFile> file_;
  std::unique_ptr<spng_ctx, FreeContext> context_;
  spng_ihdr header_{};
  Layout layout_;
  ImageFacts facts_;
  std::uint32_t row_ = 0;  ///< the next one
  RawVector<std::uint8_t> bytes_;
};

}  // namespace

std::unique_ptr<ImageReader> openPng(const std::filesystem::path& path) {
  return std::make_unique<PngReader>(path);
}

}  // namespace gnomon::image
