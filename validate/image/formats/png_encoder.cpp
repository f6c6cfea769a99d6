#include <png.h>
#include <zlib.h>

#include <algorithm>
#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <new>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/error.h"
#include "image/images.h"

namespace gnomon::image {
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

}  // namespace gnomon::image
