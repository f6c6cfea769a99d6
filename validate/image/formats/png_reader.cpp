#include "image/formats/png_reader.h"

#include <spng.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <limits>
#include <new>
#include <string>
#include <utility>

#include "common/raw_vector.h"
#include "image/formats/exif_orientation.h"

namespace gnomon::image {
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
