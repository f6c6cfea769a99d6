#include "image/formats/png_reader.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <limits>
#include <new>
#include <optional>
#include <utility>
#include <vector>

#include "common/raw_vector.h"
#include "image/formats/exif_orientation.h"
#include "image/image_error.h"

namespace gnomon {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

File openFile(const std::filesystem::path& path) {
  File file(std::fopen(path.c_str(), "rb"));
  if (!file) throw ImageError(std::string("cannot be opened: ") + std::strerror(errno));
  return file;
}

/// libpng's structures for one file. It comes back by longjmp where it fails: no function below
/// that calls it has a variable with a destructor.
class Decoder {
 public:
  explicit Decoder(const std::filesystem::path& path) : file_(openFile(path)) {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, fail, warn);
    if (png_) info_ = png_create_info_struct(png_);
    if (!info_) {
      png_destroy_read_struct(&png_, nullptr, nullptr);
      throw std::bad_alloc();
    }
    if (!readHeader()) {
      png_destroy_read_struct(&png_, &info_, nullptr);
      throw ImageError(message_.data());
    }
  }
  ~Decoder() { png_destroy_read_struct(&png_, &info_, nullptr); }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;

  [[nodiscard]] int width() const { return static_cast<int>(png_get_image_width(png_, info_)); }
  [[nodiscard]] int height() const { return static_cast<int>(png_get_image_height(png_, info_)); }
  [[nodiscard]] int channels() const { return png_get_channels(png_, info_); }
  [[nodiscard]] int bits() const { return png_get_bit_depth(png_, info_); }
  [[nodiscard]] std::size_t rowBytes() const { return png_get_rowbytes(png_, info_); }
  [[nodiscard]] bool isInterlaced() const {
    return png_get_interlace_type(png_, info_) != PNG_INTERLACE_NONE;
  }
  [[nodiscard]] int orientation() const {
#ifdef PNG_eXIf_SUPPORTED
    png_uint_32 size = 0;
    png_bytep exif = nullptr;
    if (png_get_eXIf_1(png_, info_, &size, &exif) != 0) return exifOrientation({exif, size});
#endif
    return 1;
  }

  /// @throws ImageError
  void readRow(png_bytep row) {
    if (!tryReadRow(row)) throw ImageError(message_.data());
  }
  void readAll(png_bytepp rows) {
    if (!tryReadAll(rows)) throw ImageError(message_.data());
  }
  /// What follows the pixels: a file that ends before its end is damaged.
  void readEnd() {
    if (!tryReadEnd()) throw ImageError(message_.data());
  }

 private:
  bool readHeader() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_init_io(png_, file_.get());
    png_read_info(png_, info_);
    png_set_expand(png_);
    if constexpr (std::endian::native == std::endian::little) png_set_swap(png_);
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    return true;
  }
  bool tryReadRow(png_bytep row) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_row(png_, row, nullptr);
    return true;
  }
  bool tryReadAll(png_bytepp rows) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_image(png_, rows);
    return true;
  }
  bool tryReadEnd() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_end(png_, nullptr);
    return true;
  }

  /// Copies the message, which may lie on the stack that is left.
  [[noreturn]] static void fail(png_structp png, png_const_charp message) {
    auto& kept = static_cast<Decoder*>(png_get_error_ptr(png))->message_;
    std::snprintf(kept.data(), kept.size(), "%s", message);
    png_longjmp(png, 1);
  }
  static void warn(png_structp, png_const_charp) {}

  File file_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  std::array<char, 256> message_{};
};

/// Shares of the largest value, as OpenImageIO converts them: times the reciprocal in floats.
template <typename Number>
void toShares(const std::uint8_t* row, std::size_t pixels, std::size_t count, std::size_t first,
              std::size_t end, float* out) {
  constexpr float scale = 1.0F / static_cast<float>(std::numeric_limits<Number>::max());
  for (std::size_t x = 0; x < pixels; ++x) {
    for (std::size_t c = first; c < end; ++c) {
      Number value = 0;
      std::memcpy(&value, row + (x * count + c) * sizeof value, sizeof value);
      *out++ = static_cast<float>(value) * scale;
    }
  }
}

std::vector<std::string> channelNames(int count) {
  if (count <= 2)
    return count == 1 ? std::vector<std::string>{"Y"} : std::vector<std::string>{"Y", "A"};
  std::vector<std::string> names = {"R", "G", "B"};
  if (count == 4) names.emplace_back("A");
  return names;
}

class PngReader : public ImageReader {
 public:
  explicit PngReader(std::filesystem::path path)
      : path_(std::move(path)), decoder_(std::in_place, path_), facts_(factsOf(*decoder_)) {}

  [[nodiscard]] ImageFacts facts() const override { return facts_; }

  bool goTo(int part) override {
    if (part != 0) return false;
    if (row_ > 0) {
      decoder_.emplace(path_);
      row_ = 0;
    }
    return true;
  }

  void readRows(int rows, int first, int end, NumberType type, void* values) override {
    const auto count = static_cast<std::size_t>(facts_.channelCount());
    const auto width = static_cast<std::size_t>(facts_.data.width);
    const auto from = static_cast<std::size_t>(first);
    const auto to = static_cast<std::size_t>(end);
    for (std::size_t i = 0; i < static_cast<std::size_t>(rows); ++i) {
      const std::uint8_t* row = nextRow();
      const std::size_t out = i * width * (to - from);
      if (type == NumberType::float32 && decoder_->bits() == 16) {
        toShares<std::uint16_t>(row, width, count, from, to, static_cast<float*>(values) + out);
      } else if (type == NumberType::float32) {
        toShares<std::uint8_t>(row, width, count, from, to, static_cast<float*>(values) + out);
      } else if (type == NumberType::uint8 && decoder_->bits() == 8) {
        auto* bytes = static_cast<std::uint8_t*>(values) + out;
        for (std::size_t x = 0; x < width; ++x) {
          bytes = std::copy(row + x * count + from, row + x * count + to, bytes);
        }
      } else {
        throw ImageError("its numbers are shares of 8 or 16 bits");
      }
    }
  }

 private:
  static ImageFacts factsOf(const Decoder& decoder) {
    ImageFacts facts;
    facts.data = facts.display = {0, 0, decoder.width(), decoder.height()};
    facts.channels = channelNames(decoder.channels());
    facts.numbers = decoder.bits() == 16 ? "uint16" : "uint8";
    facts.channelNumbers.assign(facts.channels.size(), facts.numbers);
    facts.alpha = facts.channel("A");
    facts.hasPlainAlpha = facts.alpha >= 0;
    facts.orientation = decoder.orientation();
    facts.pixelCount =
        static_cast<std::uint64_t>(decoder.width()) * static_cast<std::uint64_t>(decoder.height());
    facts.bytesAPixel = facts.channels.size() * (decoder.bits() == 16 ? 2 : 1);
    return facts;
  }

  const std::uint8_t* nextRow() {
    const std::size_t size = decoder_->rowBytes();
    const bool whole = decoder_->isInterlaced();  // only the last of seven passes has whole rows
    if (row_ == 0) {
      bytes_ =
          RawVector<std::uint8_t>(size * static_cast<std::size_t>(whole ? facts_.data.height : 1));
      if (whole) readInterlaced(size);
    }
    std::uint8_t* row = bytes_.data() + (whole ? size * static_cast<std::size_t>(row_) : 0);
    if (!whole) decoder_->readRow(row);
    if (++row_ == facts_.data.height) decoder_->readEnd();
    return row;
  }

  void readInterlaced(std::size_t size) {
    std::vector<png_bytep> rows(static_cast<std::size_t>(facts_.data.height));
    for (std::size_t y = 0; y < rows.size(); ++y) rows[y] = bytes_.data() + y * size;
    decoder_->readAll(rows.data());
  }

  std::filesystem::path path_;
  std::optional<Decoder> decoder_;
  ImageFacts facts_;
  int row_ = 0;  ///< the next one
  RawVector<std::uint8_t> bytes_;
};

}  // namespace

std::unique_ptr<ImageReader> openPng(const std::filesystem::path& path) {
  return std::make_unique<PngReader>(path);
}

}  // namespace gnomon
