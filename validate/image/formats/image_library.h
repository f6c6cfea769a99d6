#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "image/image_format.h"
#include "image/formats/image_reader.h"
#include "image/formats/image_writer.h"

namespace gnomon {

/// OpenImageIO, as far as it is used here. It links some 250 libraries, and to load them takes
/// longer than many a command: so all that knows it is a module, which is loaded when it is needed.
class ImageLibrary {
 public:
  ImageLibrary() = default;
  ImageLibrary(const ImageLibrary&) = delete;
  ImageLibrary& operator=(const ImageLibrary&) = delete;
  virtual ~ImageLibrary() = default;

  /// Opens an image by the reader of its format and no other. Colours that were written
  /// unmultiplied by alpha stay so. Asked by ImageFile alone, which knows the format.
  /// @throws ImageError
  [[nodiscard]] virtual std::unique_ptr<ImageReader> open(const std::filesystem::path& path,
                                                          ImageFormat format) const = 0;
  /// Begins an EXR, packed by `zip`. Same numbers, same bytes: it does not hold the time.
  /// @throws ImageError
  [[nodiscard]] virtual std::unique_ptr<ImageWriter> createExr(
      const std::filesystem::path& path, const ExrDescription& description) const = 0;
  /// The bytes of such a file of floats.
  /// @param values  all channels of a pixel beside each other, rows from the top
  /// @throws ImageError
  [[nodiscard]] virtual std::string exrBytes(const ExrDescription& description,
                                             const std::vector<float>& values) const = 0;
};

/// The library. The first call loads it: the file that the environment's GNOMON_IMAGE_MODULE names,
/// else beside the installed program (../lib/gnomon), else where the linker looks for libraries,
/// else in the build tree. It stays loaded until the process ends.
/// @throws InternalError where it cannot be loaded
const ImageLibrary& imageLibrary();

}  // namespace gnomon
