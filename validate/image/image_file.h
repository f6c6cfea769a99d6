#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "common/raw_vector.h"
#include "image/image_format.h"
#include "image/image_module.h"

namespace gnomon::image {

/// A picture of one of the formats of ImageFormat, told by its content. Whatever goes wrong in a
/// reader is an InputError of one line that names the file.
class ImageFile {
 public:
  /// @throws InputError where it is missing, no file, of another format (saying which), or damaged
  explicit ImageFile(std::filesystem::path path);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] ImageFacts facts() const;
  /// As ImageReader's.
  bool goTo(int part);

  /// Refuses the part gone to before anything of it is decoded: where its pixels are deep, in
  /// layers or none; where the file is too short to hold as many; where memory is.
  /// @param bytesKept  what the caller will hold of each pixel
  /// @throws InputError, MemoryError
  void requireReadable(double bytesKept) const;

  /// As ImageReader's.
  void readRows(int rows, int first, int end, float* values);

  /// Reads the part gone to, some rows at a time, so that a picture is never in memory twice, and
  /// places them: the picture is the display window, and what lies outside of it is left out.
  /// @param take  `take(const float* values, int column, int row, int count)`: channels
  ///   [first, end), beside each other, of `count` neighbouring pixels of the picture
  template <typename Take>
  void readPlaced(int first, int end, const Take& take) {
    const ImageFacts facts = this->facts();
    const ImageWindow& data = facts.data;
    const int most = rowsAtOnce(facts, end - first);
    const std::size_t step =
        static_cast<std::size_t>(data.width) * static_cast<std::size_t>(end - first);
    RawVector<float> values(static_cast<std::size_t>(most) * step);
    const std::int64_t left = std::max<std::int64_t>(facts.display.x, data.x);
    const std::int64_t right = std::min(facts.display.right(), data.right());
    for (int top = 0; top < data.height; top += most) {
      const int rows = std::min(most, data.height - top);
      readRows(rows, first, end, values.data());
      for (int i = 0; i < rows; ++i) {
        const std::int64_t row = std::int64_t{data.y} + top + i - facts.display.y;
        if (row < 0 || row >= facts.display.height || left >= right) continue;
        take(static_cast<const float*>(values.data()) + static_cast<std::size_t>(i) * step +
                 (left - data.x) * (end - first),
             static_cast<int>(left - facts.display.x), static_cast<int>(row),
             static_cast<int>(right - left));
      }
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
