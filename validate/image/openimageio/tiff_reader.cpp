#include "tiff_reader.h"

#include <tiffio.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <new>
#include <optional>
#include <utility>
#include <vector>

namespace gnomon::image {
namespace {

struct FreeOptions {
  void operator()(TIFFOpenOptions* options) const { TIFFOpenOptionsFree(options); }
};
struct CloseTiff {
  void operator()(TIFF* file) const { TIFFClose(file); }
};

/// Keeps libtiff's first error instead of printing it.
int keepError(TIFF*, void* place, const char*, const char* format, std::va_list arguments) {
  auto& error = *static_cast<std::string*>(place);
  std::array<char, 500> text{};
  std::vsnprintf(text.data(), text.size(), format, arguments);
  if (error.empty()) error = text.data();
  return 1;
}

int ignoreWarning(TIFF*, void*, const char*, const char*, std::va_list) {
  return 1;
}

/// An open file, and what libtiff last said of it.
class Tiff {
 public:
  explicit Tiff(const std::filesystem::path& path) {
    const std::unique_ptr<TIFFOpenOptions, FreeOptions> options(TIFFOpenOptionsAlloc());
    if (!options) throw std::bad_alloc();
    TIFFOpenOptionsSetErrorHandlerExtR(options.get(), &keepError, error_.get());
    TIFFOpenOptionsSetWarningHandlerExtR(options.get(), &ignoreWarning, nullptr);
    // m: not mapped into memory, where a file that shrinks ends the process.
    file_.reset(TIFFOpenExt(path.c_str(), "rm", options.get()));
    if (!file_) fail();
  }

  [[nodiscard]] TIFF* get() const { return file_.get(); }

  /// libtiff answers some damages with a success and an error.
  void check(bool isDone) const {
    if (!isDone || !error_->empty()) fail();
  }

  bool goTo(int part) const {
    const bool isThere = TIFFSetDirectory(get(), static_cast<tdir_t>(part)) != 0;
    error_->clear();
    // JPEG's own colours, which libtiff converts.
    if (isThere &&
        number<std::uint16_t>(TIFFTAG_COMPRESSION, COMPRESSION_NONE) == COMPRESSION_JPEG) {
      TIFFSetField(get(), TIFFTAG_JPEGCOLORMODE, JPEGCOLORMODE_RGB);
    }
    return isThere;
  }

  /// A tag's number, or its default.
  template <typename Number>
  [[nodiscard]] Number number(std::uint32_t tag, Number standard) const {
    Number found = standard;
    return TIFFGetFieldDefaulted(get(), tag, &found) != 0 ? found : standard;
  }

 private:
  [[noreturn]] void fail() const { throw ImageError(*error_); }

  std::unique_ptr<std::string> error_ = std::make_unique<std::string>();
  std::unique_ptr<TIFF, CloseTiff> file_;
};

/// How the numbers of a picture lie in its rows.
struct Layout {
  int bits = 1;
  int format = SAMPLEFORMAT_UINT;
  int samples = 1;
  int colours = 1;  ///< channels before the extra ones; three of a palette's one sample
  int photometric = PHOTOMETRIC_MINISBLACK;
  bool isSeparate = false;  ///< each channel has rows of its own

  [[nodiscard]] bool hasPalette() const { return photometric == PHOTOMETRIC_PALETTE; }
  [[nodiscard]] bool isWhole() const { return format == SAMPLEFORMAT_UINT; }
  [[nodiscard]] int channels() const { return samples + (hasPalette() ? 2 : 0); }
  /// The sample that a channel comes from.
  [[nodiscard]] int sample(int channel) const {
    return hasPalette() ? std::max(0, channel - 2) : channel;
  }
  /// What integers are shares of; 1 of other numbers.
  [[nodiscard]] double largest() const {
    if (format == SAMPLEFORMAT_IEEEFP || bits > 16) return 1;
    return std::exp2(isWhole() ? bits : bits - 1) - 1;
  }
  [[nodiscard]] bool canInvertWhite() const { return isWhole() && bits <= 16; }
  [[nodiscard]] bool isWhiteZero() const { return photometric == PHOTOMETRIC_MINISWHITE; }

  /// "uint8", "int16", "half", "float" …
  [[nodiscard]] std::string type() const {
    if (hasPalette()) return "uint16";
    if (format == SAMPLEFORMAT_IEEEFP) return bits == 16 ? "half" : bits == 32 ? "float" : "double";
    const int size = bits <= 8 ? 8 : bits <= 16 ? 16 : bits;
    return (isWhole() ? "uint" : "int") + (size == 32 ? "" : std::to_string(size));
  }

  /// Numbers that are not read, or nothing.
  [[nodiscard]] std::string unread() const {
    const bool isInteger = isWhole() || format == SAMPLEFORMAT_INT;
    const bool isRead = format == SAMPLEFORMAT_IEEEFP ? bits == 16 || bits == 32 || bits == 64
                        : isWhole()
                            ? (bits >= 1 && bits <= 16) || bits == 32
                            : format == SAMPLEFORMAT_INT && (bits == 8 || bits == 16 || bits == 32);
    if (isRead) return {};
    return std::to_string(bits) + (isWhole()                       ? "-bit integers"
                                   : isInteger                     ? "-bit signed integers"
                                   : format == SAMPLEFORMAT_IEEEFP ? "-bit floats"
                                                                   : "-bit complex numbers");
  }
};

std::string modelOf(int photometric, bool isJpeg) {
  switch (photometric) {
    case PHOTOMETRIC_MINISWHITE:
    case PHOTOMETRIC_MINISBLACK:
    case PHOTOMETRIC_RGB:
    case PHOTOMETRIC_PALETTE:
    case PHOTOMETRIC_MASK:
      return {};
    case PHOTOMETRIC_SEPARATED:
      return "CMYK";
    case PHOTOMETRIC_YCBCR:
      return isJpeg ? "" : "YCbCr";
    case PHOTOMETRIC_CIELAB:
    case PHOTOMETRIC_ICCLAB:
    case PHOTOMETRIC_ITULAB:
      return "CIELAB";
    case PHOTOMETRIC_LOGL:
    case PHOTOMETRIC_LOGLUV:
      return "LogLuv";
    default:
      return "PhotometricInterpretation " + std::to_string(photometric);
  }
}

std::string codingOf(int compression) {
  switch (compression) {
    case COMPRESSION_NONE:
      return "none";
    case COMPRESSION_LZW:
      return "lzw";
    case COMPRESSION_DEFLATE:
    case COMPRESSION_ADOBE_DEFLATE:
      return "zip";
    case COMPRESSION_PACKBITS:
      return "packbits";
    case COMPRESSION_JPEG:
      return "jpeg";
    default:
      return "other";
  }
}

template <typename Number>
Number at(const std::uint8_t* row, std::size_t i) {
  Number value;
  std::memcpy(&value, row + i * sizeof value, sizeof value);
  return value;
}

/// IEEE 754's binary16.
double halfOf(std::uint16_t bits) {
  const int exponent = bits >> 10 & 31;
  const int digits = bits & 1023;
  const double size = exponent == 31  ? (digits == 0 ? HUGE_VAL : std::nan(""))
                      : exponent == 0 ? std::ldexp(digits, -24)
                                      : std::ldexp(1024 + digits, exponent - 25);
  return (bits & 0x8000) == 0 ? size : -size;
}

/// An integer of any number of bits, which follow one another from the highest of each byte.
unsigned packedBits(const std::uint8_t* row, std::size_t i, unsigned bits) {
  unsigned value = 0;
  for (std::size_t bit = i * bits; bit < (i + 1) * bits; ++bit) {
    value = value << 1 | (row[bit / 8] >> (7 - bit % 8) & 1U);
  }
  return value;
}

/// Sample i of a row as libtiff gives it, in the processor's order of bytes.
double sampleAt(const Layout& layout, const std::uint8_t* row, std::size_t i) {
  const bool isFloat = layout.format == SAMPLEFORMAT_IEEEFP;
  switch (layout.bits) {
    case 8:
      return layout.isWhole() ? row[i] : at<std::int8_t>(row, i);
    case 16:
      if (isFloat) return halfOf(at<std::uint16_t>(row, i));
      return layout.isWhole() ? at<std::uint16_t>(row, i) : at<std::int16_t>(row, i);
    case 32:
      if (isFloat) return static_cast<double>(at<float>(row, i));
      if (layout.isWhole()) return at<std::uint32_t>(row, i);
      return at<std::int32_t>(row, i);
    case 64:
      return at<double>(row, i);
    default:
      return packedBits(row, i, static_cast<unsigned>(layout.bits));
  }
}

class TiffReader : public ImageReader {
 public:
  explicit TiffReader(std::filesystem::path path) : path_(std::move(path)) {
    files_.emplace_back(path_);
    constexpr int mostPages = 100;
    for (int page = 0; page < mostPages && files_.front().goTo(page); ++page) {
      pages_.push_back(files_.front().number<std::uint32_t>(TIFFTAG_SUBFILETYPE, 0));
    }
    goToPart(0);
  }

  [[nodiscard]] ImageFacts facts() const override { return facts_; }

  bool goTo(int part) override {
    if (!files_.front().goTo(part)) return false;
    files_.erase(files_.begin() + 1, files_.end());
    goToPart(part);
    return true;
  }

  void readRows(int rows, int first, int end, float* values) override {
    const auto step = static_cast<std::size_t>(width_) * static_cast<std::size_t>(end - first);
    for (int i = 0; i < rows; ++i, ++row_) {
      float* const out = values + static_cast<std::size_t>(i) * step;
      if (tileWidth_ == 0) {
        readRow(first, end, out);
        continue;
      }
      const int inTile = row_ % tileHeight_;
      if (inTile == 0) readTiles(first, end);
      std::copy_n(tiles_.data() + static_cast<std::size_t>(inTile) * step, step, out);
    }
  }

 private:
  [[nodiscard]] TIFF* file() const { return files_.front().get(); }

  void goToPart(int part) {
    const Tiff& tiff = files_.front();
    tiff.goTo(part);
    part_ = part;
    row_ = 0;
    layout_ = {};
    layout_.bits = tiff.number<std::uint16_t>(TIFFTAG_BITSPERSAMPLE, 1);
    layout_.format = tiff.number<std::uint16_t>(TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT);
    if (layout_.format == SAMPLEFORMAT_VOID) layout_.format = SAMPLEFORMAT_UINT;
    layout_.samples = tiff.number<std::uint16_t>(TIFFTAG_SAMPLESPERPIXEL, 1);
    layout_.photometric = tiff.number<std::uint16_t>(
        TIFFTAG_PHOTOMETRIC, layout_.samples < 3 ? PHOTOMETRIC_MINISBLACK : PHOTOMETRIC_RGB);
    layout_.isSeparate = layout_.samples > 1 &&
                         tiff.number<std::uint16_t>(TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG) ==
                             PLANARCONFIG_SEPARATE;
    tileWidth_ = tileHeight_ = 0;
    if (TIFFIsTiled(file()) != 0) {
      tileWidth_ = static_cast<int>(tiff.number<std::uint32_t>(TIFFTAG_TILEWIDTH, 0));
      tileHeight_ = static_cast<int>(tiff.number<std::uint32_t>(TIFFTAG_TILELENGTH, 0));
      if (tileWidth_ < 1 || tileHeight_ < 1) throw ImageError("its tiles have no pixels");
    }
    setFacts(tiff);
    if (layout_.hasPalette()) readPalette();
  }

  void setFacts(const Tiff& tiff) {
    facts_ = {};
    width_ = static_cast<int>(tiff.number<std::uint32_t>(TIFFTAG_IMAGEWIDTH, 0));
    const auto height = static_cast<int>(tiff.number<std::uint32_t>(TIFFTAG_IMAGELENGTH, 0));
    facts_.data = facts_.display = {0, 0, width_, height};
    setWindows(tiff);
    requireTile(height);
    facts_.depth = static_cast<int>(tiff.number<std::uint32_t>(TIFFTAG_IMAGEDEPTH, 1));
    const int compression = tiff.number<std::uint16_t>(TIFFTAG_COMPRESSION, COMPRESSION_NONE);
    facts_.coding = codingOf(compression);
    facts_.colourModel = modelOf(layout_.photometric, compression == COMPRESSION_JPEG);
    setChannels();
    facts_.orientation = tiff.number<std::uint16_t>(TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
    facts_.unreadNumbers = layout_.unread();
    facts_.isWhiteZero = layout_.isWhiteZero() && !layout_.canInvertWhite();
    facts_.otherPage = otherPage();
    facts_.noData = noData();
    if (facts_.noData && isInverted(0)) facts_.noData = layout_.largest() - *facts_.noData;
    facts_.bytesAPixel = layout_.samples * layout_.bits / 8.0;
  }

  /// That the page gone to is not the whole picture, or nothing.
  [[nodiscard]] std::string otherPage() const {
    const auto page = static_cast<std::size_t>(part_);
    const std::uint32_t kind = page < pages_.size() ? pages_[page] : 0;
    if ((kind & FILETYPE_REDUCEDIMAGE) != 0) return "it is a reduced copy of another";
    const auto masks = std::find(pages_.begin(), pages_.end(), FILETYPE_MASK);
    if (masks == pages_.end()) return {};
    return "page " + std::to_string(masks - pages_.begin() + 1) + " says which pixels are missing";
  }

  /// A picture within a larger one (Pixar's tags, which OpenImageIO writes too). A place on a page
  /// alone has no such picture.
  void setWindows(const Tiff& tiff) {
    const auto fullWidth = tiff.number<std::uint32_t>(TIFFTAG_PIXAR_IMAGEFULLWIDTH, 0);
    const auto fullHeight = tiff.number<std::uint32_t>(TIFFTAG_PIXAR_IMAGEFULLLENGTH, 0);
    const auto place = [&](std::uint32_t position, std::uint32_t resolution) {
      const float pixels = tiff.number(position, 0.0F) * tiff.number(resolution, 1.0F);
      constexpr float farthest = 1 << 20;
      if (!(std::abs(pixels) <= farthest)) throw ImageError("its place in its picture is none");
      return static_cast<int>(std::lround(pixels));
    };
    if (fullWidth == 0 || fullHeight == 0) return;
    facts_.display = {0, 0, static_cast<int>(fullWidth), static_cast<int>(fullHeight)};
    facts_.data.x = place(TIFFTAG_XPOSITION, TIFFTAG_XRESOLUTION);
    facts_.data.y = place(TIFFTAG_YPOSITION, TIFFTAG_YRESOLUTION);
  }

  /// A tile may be larger than the picture, but not by much: all of it is decoded.
  void requireTile(int height) const {
    constexpr double usual = 4096.0 * 4096.0;
    if (static_cast<double>(tileWidth_) * tileHeight_ >
        std::max(usual, static_cast<double>(width_) * height)) {
      throw ImageError("a tile of it is far larger than the picture");
    }
  }

  void setChannels() {
    const int photometric = layout_.photometric;
    const bool isColour =
        layout_.hasPalette() ||
        (layout_.samples >= 3 && photometric != PHOTOMETRIC_MINISWHITE &&
         photometric != PHOTOMETRIC_MINISBLACK && photometric != PHOTOMETRIC_MASK);
    layout_.colours = isColour ? 3 : 1;
    facts_.channels =
        isColour ? std::vector<std::string>{"R", "G", "B"} : std::vector<std::string>{"Y"};
    std::uint16_t extras = 0;
    const std::uint16_t* kinds = nullptr;
    TIFFGetField(file(), TIFFTAG_EXTRASAMPLES, &extras, &kinds);
    for (int c = layout_.colours; c < layout_.channels(); ++c) {
      const int extra = c - layout_.colours;
      const int kind = kinds != nullptr && extra < extras ? kinds[extra] : EXTRASAMPLE_UNSPECIFIED;
      if (kind == EXTRASAMPLE_UNSPECIFIED || facts_.alpha >= 0) {
        facts_.channels.push_back("channel" + std::to_string(c));
        continue;
      }
      facts_.alpha = c;
      facts_.hasPlainAlpha = kind == EXTRASAMPLE_UNASSALPHA;
      facts_.channels.emplace_back("A");
    }
    facts_.channelNumbers.assign(facts_.channels.size(), layout_.type());
  }

  /// GDAL's tag, which libtiff does not know: a text.
  [[nodiscard]] std::optional<double> noData() const {
    constexpr std::uint32_t gdalNoData = 42113;
    constexpr double lowest16 = -0x8000;
    const TIFFField* const field = TIFFFindField(file(), gdalNoData, TIFF_ANY);
    const bool isText = field != nullptr && TIFFFieldDataType(field) == TIFF_ASCII;
    const char* text = nullptr;
    std::uint32_t count = 0;
    const bool isCounted = isText && TIFFFieldPassCount(field) != 0;
    const bool isThere = isText && (isCounted ? TIFFGetField(file(), gdalNoData, &count, &text)
                                              : TIFFGetField(file(), gdalNoData, &text)) != 0;
    if (!isThere || text == nullptr) {
      const bool isSigned16 = layout_.format == SAMPLEFORMAT_INT && layout_.bits == 16;
      return isSigned16 ? std::optional(lowest16) : std::nullopt;
    }
    std::string_view found = isCounted ? std::string_view(text, strnlen(text, count)) : text;
    const std::size_t start = found.find_first_not_of(" +");
    found.remove_prefix(std::min(start, found.size()));
    double value = 0;
    const auto [end, error] = std::from_chars(found.data(), found.data() + found.size(), value);
    if (error == std::errc::result_out_of_range) return std::nullopt;
    if (error != std::errc{}) throw ImageError("its no-data value is no number");
    return value;
  }

  void readPalette() {
    std::array<const std::uint16_t*, 3> colours{};
    if (!layout_.isWhole() || layout_.bits > 16 ||
        TIFFGetField(file(), TIFFTAG_COLORMAP, &colours[0], &colours[1], &colours[2]) == 0) {
      throw ImageError("its palette is missing");
    }
    const std::size_t count = std::size_t{1} << layout_.bits;
    // Old writers fill 8 bits of 16.
    const auto isSmall = [&](const std::uint16_t* values) {
      return std::all_of(values, values + count, [](std::uint16_t value) { return value < 256; });
    };
    const int scale = std::all_of(colours.begin(), colours.end(), isSmall) ? 257 : 1;
    for (std::size_t k = 0; k < 3; ++k) {
      palette_[k].resize(count);
      for (std::size_t i = 0; i < count; ++i) {
        const bool isNoData = facts_.noData == static_cast<double>(i);
        palette_[k][i] = isNoData ? NAN : numberOf(colours[k][i] * scale, 0xffff);
      }
    }
    if (facts_.noData) facts_.noData = NAN;
  }

  /// Channel c of a pixel.
  /// @param place  of its sample in the row
  [[nodiscard]] float channelAt(int c, const std::uint8_t* row, std::size_t place) const {
    const double found = sampleAt(layout_, row, place);
    if (layout_.hasPalette() && c < 3) {
      return palette_[static_cast<std::size_t>(c)][static_cast<std::size_t>(found)];
    }
    const double largest = layout_.largest();
    return numberOf(isInverted(c) ? largest - found : found, largest);
  }

  /// Whether white is 0 in the file.
  [[nodiscard]] bool isInverted(int channel) const {
    return layout_.isWhiteZero() && layout_.canInvertWhite() && channel < layout_.colours;
  }

  /// The file of the n-th plane read: one for each, since rows are unpacked in turn.
  const Tiff& plane(int n) {
    while (files_.size() <= static_cast<std::size_t>(n)) {
      files_.emplace_back(path_);
      files_.back().goTo(part_);
    }
    return files_[static_cast<std::size_t>(n)];
  }

  /// Takes `count` pixels out of decoded rows.
  void take(int first, int end, int sample, const std::uint8_t* row, int count, float* out) const {
    const int step = end - first;
    for (int c = first; c < end; ++c) {
      if (layout_.isSeparate && layout_.sample(c) != sample) continue;
      const int inPixel = layout_.isSeparate ? 0 : layout_.sample(c);
      const int samples = layout_.isSeparate ? 1 : layout_.samples;
      for (int x = 0; x < count; ++x) {
        out[static_cast<std::ptrdiff_t>(x) * step + c - first] =
            channelAt(c, row,
                      static_cast<std::size_t>(x) * static_cast<std::size_t>(samples) +
                          static_cast<std::size_t>(inPixel));
      }
    }
  }

  /// The planes that hold channels [first, end).
  [[nodiscard]] std::pair<int, int> planes(int first, int end) const {
    if (!layout_.isSeparate) return {0, 1};
    return {layout_.sample(first), layout_.sample(end - 1) + 1};
  }

  void readRow(int first, int end, float* out) {
    const auto [from, to] = planes(first, end);
    for (int sample = from; sample < to; ++sample) {
      const Tiff& tiff = plane(sample - from);
      bytes_.resize(static_cast<std::size_t>(TIFFScanlineSize64(tiff.get())));
      tiff.check(TIFFReadScanline(tiff.get(), bytes_.data(), static_cast<std::uint32_t>(row_),
                                  static_cast<std::uint16_t>(sample)) == 1);
      take(first, end, sample, bytes_.data(), width_, out);
    }
  }

  /// The tiles beside each other whose first row is the next one.
  void readTiles(int first, int end) {
    const auto [from, to] = planes(first, end);
    const Tiff& tiff = files_.front();
    bytes_.resize(static_cast<std::size_t>(TIFFTileSize64(tiff.get())));
    const auto rowBytes = static_cast<std::size_t>(TIFFTileRowSize64(tiff.get()));
    const auto step = static_cast<std::size_t>(end - first);
    const int rows = std::min(tileHeight_, facts_.data.height - row_);
    tiles_.resize(static_cast<std::size_t>(rows) * static_cast<std::size_t>(width_) * step);
    for (int left = 0; left < width_; left += tileWidth_) {
      for (int sample = from; sample < to; ++sample) {
        tiff.check(TIFFReadTile(tiff.get(), bytes_.data(), static_cast<std::uint32_t>(left),
                                static_cast<std::uint32_t>(row_), 0,
                                static_cast<std::uint16_t>(sample)) >= 0);
        for (int y = 0; y < rows; ++y) {
          take(first, end, sample, bytes_.data() + static_cast<std::size_t>(y) * rowBytes,
               std::min(tileWidth_, width_ - left),
               tiles_.data() + (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                                static_cast<std::size_t>(left)) *
                                   step);
        }
      }
    }
  }

  std::filesystem::path path_;
  std::vector<Tiff> files_;           ///< one, or of a picture in planes one for each that is read
  std::vector<std::uint32_t> pages_;  ///< NewSubfileType of each
  int part_ = 0;
  int row_ = 0;  ///< the next one
  int width_ = 0;
  int tileWidth_ = 0;  ///< 0: strips
  int tileHeight_ = 0;
  Layout layout_;
  ImageFacts facts_;
  std::array<std::vector<float>, 3> palette_;
  std::vector<std::uint8_t> bytes_;
  std::vector<float> tiles_;
};

}  // namespace

std::unique_ptr<ImageReader> openTiff(const std::filesystem::path& path) {
  return std::make_unique<TiffReader>(path);
}

}  // namespace gnomon::image
