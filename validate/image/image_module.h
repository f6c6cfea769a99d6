#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "image/image_format.h"

namespace gnomon::image {

/// An image that a library cannot read or write, in its words. These do not name the file and may
/// be of several lines or of none: who asked for the image says the rest.
class ImageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// How the numbers of an image lie in a file or in memory.
enum class NumberType { uint32, half, float32 };

/// Its name in ImageFacts.
constexpr const char* nameOf(NumberType type) {
  constexpr const char* names[] = {"uint", "half", "float"};
  return names[static_cast<int>(type)];
}

/// A rectangle of pixels.
struct ImageWindow {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;

  [[nodiscard]] std::int64_t right() const { return std::int64_t{x} + width; }
  [[nodiscard]] std::int64_t below() const { return std::int64_t{y} + height; }
};

/// What a file tells of one of its parts before any pixel is read. A damaged or foreign file may
/// say anything.
struct ImageFacts {
  ImageWindow data;     ///< the pixels that it holds
  ImageWindow display;  ///< the picture; that of the data where the file has no other
  int depth = 1;        ///< layers of pixels
  bool isDeep = false;  ///< several values a pixel and channel
  std::vector<std::string> channels;
  std::vector<std::string> channelNumbers;  ///< each channel's type: "uint8", "half", "float" …
  int alpha = -1;                           ///< index of a channel; none
  int z = -1;                               ///< index of a channel; none
  bool hasPlainAlpha = false;               ///< colours do not come multiplied by it
  int orientation = 1;                      ///< as Exif counts them, 1 upright
  std::string colourModel;                  ///< "CMYK" …; empty: greys, or red, green and blue
  bool isWhiteZero = false;                 ///< white is 0, and readRows does not turn it round
  std::string unreadNumbers;     ///< a type of numbers that readRows cannot give; empty: none
  std::string otherPage;         ///< why this page is not the whole picture; empty: it is
  std::optional<double> noData;  ///< the file's number for "no value"
  double bytesAPixel = 0;        ///< in the file, unpacked
  std::string coding;            ///< how they are packed, as OpenImageIO names it

  [[nodiscard]] int channelCount() const { return static_cast<int>(channels.size()); }
  /// The index of a channel, -1 where there is none of this name.
  [[nodiscard]] int channel(const std::string& name) const {
    for (int c = 0; c < channelCount(); ++c) {
      if (channels[static_cast<std::size_t>(c)] == name) return c;
    }
    return -1;
  }
};

/// The largest number of a channel whose integers are shares of it: those of up to 16 bits. 1 where
/// numbers are read as they stand: floats, and integers of 32 bits, which are counts or flags.
/// @param type  as ImageFacts has it
constexpr double largestOf(std::string_view type) {
  return type == "uint8"    ? 0xff
         : type == "int8"   ? 0x7f
         : type == "uint16" ? 0xffff
         : type == "int16"  ? 0x7fff
                            : 1;
}

/// What readRows gives for a number of a file.
constexpr float numberOf(double number, double largest) {
  return static_cast<float>(number) * (1.0F / static_cast<float>(largest));
}

/// An image file that is open for reading.
class ImageReader {
 public:
  ImageReader() = default;
  ImageReader(const ImageReader&) = delete;
  ImageReader& operator=(const ImageReader&) = delete;
  virtual ~ImageReader() = default;

  /// Of the part gone to, at first the file's first.
  [[nodiscard]] virtual ImageFacts facts() const = 0;
  /// Goes to a part, and there to its first row; false where the file has none of this number.
  virtual bool goTo(int part) = 0;

  /// Reads channels [first, end) of the next rows of the part gone to, beside each other, one row
  /// after the other from the top of its data window, as floats: see `numberOf`. All rows of a part
  /// are read with the same channels.
  /// @param rows    at most as many as are left
  /// @param values  rows × width × (end - first) numbers
  /// @throws ImageError
  virtual void readRows(int rows, int first, int end, float* values) = 0;
};

/// What a file's header says apart from the pixels, by name.
using ImageAttributes = std::map<std::string, std::variant<int, float, std::string>>;

/// An EXR to be written.
struct ExrDescription {
  int width = 0;
  int height = 0;
  std::vector<std::string> channels;
  NumberType numbers = NumberType::float32;  ///< in the file
  ImageAttributes attributes;
};

/// The numbers of a picture, asked for from the top, some rows at a time.
struct ImageRows {
  NumberType type = NumberType::float32;  ///< of the numbers given
  int most = 1;                           ///< rows asked for at once, at most
  /// Rows [top, top + rows), all channels of a pixel beside each other; theirs until the next call.
  std::function<const void*(int top, int rows)> at;
};

/// OpenImageIO, as far as it is used here. It links some 250 libraries, and to load them takes
/// 0.19 s, twenty times as long as a program without them needs to start: so all that knows it is a
/// module of two functions, which is loaded when it is needed.
struct ImageModule {
  /// Opens an image by the reader of its format and no other. Colours that were written
  /// unmultiplied by alpha stay so. Asked by ImageFile alone, which knows the format.
  /// @throws ImageError
  std::unique_ptr<ImageReader> (*open)(const std::filesystem::path& path, ImageFormat format);
  /// Writes an EXR, packed by `zip`. Same numbers, same bytes: it does not hold the time.
  /// @param file  an open one, which stays open; none: the bytes are returned
  /// @throws ImageError
  std::string (*writeExr)(std::optional<int> file, const ExrDescription& description,
                          const ImageRows& rows);
};

/// The names by which the module exports its ImageModule, and the version of it: a text that is
/// another for every change of these declarations.
constexpr const char* imageModuleSymbol = "gnomonImageModule";
constexpr const char* imageModuleVersionSymbol = "gnomonImageModuleVersion";

/// The module. The first call loads it: the file that the environment's GNOMON_IMAGE_MODULE names,
/// else the one that is installed with the program or library, else the build's. It stays loaded
/// until the process ends.
/// @throws InternalError where it cannot be loaded, or is of another version than the program
const ImageModule& imageModule();

}  // namespace gnomon::image
