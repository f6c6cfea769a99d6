// Any bytes as a height image. The first byte chooses the format that the file's name promises;
// what is in it is OpenImageIO's to find out.

#include <array>
#include <cmath>

#include "fuzz/reader_fuzz.h"
#include "relief/height_image.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gnomon;
  constexpr std::array<std::string_view, 3> extensions = {".png", ".pgm", ".exr"};
  if (size == 0) return 0;
  test::fuzzReader(data + 1, size - 1, extensions[data[0] % extensions.size()],
                   [](const std::filesystem::path& path) {
                     const HeightField field = readHeightImage(path, 0, 1, Wrap::repeat);
                     if (!std::isfinite(field.at({0.3, 0.7}))) std::abort();
                   });
  return 0;
}
