#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "common/raw_vector.h"
#include "image/image_format.h"
#include "image/image_reader.h"

namespace gnomon::image {

/// A picture of one of the formats of ImageFormat, told by its content. Whatever goes wrong in a
/// reader is an InputError of one line that names the file.
class ImageFile {
 public:
  /// @throws InputError where it is missing, no file, of another format (saying which), or damaged
  explicit ImageFile(std::filesystem::path path);

  [[nodiscard]] ImageFacts facts() const;
  /// As ImageReader's.
  bool goTo(int part);

  /// Refuses the part gone to before anything of it is decoded: where its pixels are deep, in
  /// layers or none; where the file is too short to hold as many; where memory is.
  /// @param bytesKept  what the caller will hold of each pixel
  /// @throws InputError, MemoryError
  void requireReadable(double bytesKept) const;

  /// As ImageReader's.
  void readRows(int rows, int first, int end, NumberType type, void* values);

  /// Reads all rows of the part gone to, some at a time, so that a picture is never in memory
  /// twice.
  /// @param take  `take(const T* values, int top, int rows)`: channels [first, end) of rows
  ///   [top, top + rows) beside each other
  template <typename T, typename Take>
  void readBands(int first, int end, NumberType type, const Take& take) {
    const ImageFacts facts = this->facts();
    const int most = rowsAtOnce(facts, end - first);
    RawVector<T> values(static_cast<std::size_t>(most) *
                        static_cast<std::size_t>(facts.data.width) *
                        static_cast<std::size_t>(end - first));
    for (int top = 0; top < facts.data.height; top += most) {
      const int rows = std::min(most, facts.data.height - top);
      readRows(rows, first, end, type, values.data());
      take(static_cast<const T*>(values.data()), top, rows);
    }
  }

  /// @throws InputError "FILE: WHAT", in one line
  [[noreturn]] void refuse(const std::string& what) const;

 private:
  /// What a header states.
  struct Size {
    int width, height;
    double bytesAPixel;  ///< unpacked
  };
  /// Refuses a size that the file is too short for, or memory too small.
  void requireRoom(const Size& size, const std::string& coding, double bytesKept) const;
  static int rowsAtOnce(const ImageFacts& facts, int channels);

  std::filesystem::path path_;
  std::uint64_t bytes_ = 0;  ///< of the file
  ImageFormat format_ = ImageFormat::png;
  std::unique_ptr<ImageReader> reader_;
};

}  // namespace gnomon::image
