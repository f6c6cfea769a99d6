#pragma once

#include <string>
#include <vector>

#include "image/formats/image_attributes.h"
#include "image/formats/number_type.h"

namespace gnomon {

/// An EXR to be written.
struct ExrDescription {
  int width = 0;
  int height = 0;
  std::vector<std::string> channels;
  NumberType numbers = NumberType::float32;
  ImageAttributes attributes;
};

/// An image file that is open for writing.
class ImageWriter {
 public:
  ImageWriter() = default;
  ImageWriter(const ImageWriter&) = delete;
  ImageWriter& operator=(const ImageWriter&) = delete;
  virtual ~ImageWriter() = default;

  /// Writes rows [top, bottom), one after the other from the top: all channels of a pixel beside
  /// each other.
  /// @throws ImageError
  virtual void writeRows(int top, int bottom, NumberType type, const void* values) = 0;
  /// Ends the file. Without it what was written is no image.
  /// @throws ImageError
  virtual void close() = 0;
};

}  // namespace gnomon
