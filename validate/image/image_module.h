#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "image/image_format.h"
#include "image/image_reader.h"

namespace gnomon::image {

/// What a file's header says beside the pixels, by name.
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
