// Any bytes as a mask picture of another renderer. The first byte chooses the format that the
// file's name promises; what is in it is OpenImageIO's to find out.

#include <array>

#include "fuzz/reader_fuzz.h"
#include "report/mask_picture.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gnomon;
  constexpr std::array<std::string_view, 4> extensions = {".png", ".exr", ".tif", ".pgm"};
  if (size == 0) return 0;
  test::fuzzReader(data + 1, size - 1, extensions[data[0] % extensions.size()],
                   [](const std::filesystem::path& path) {
                     MaskReading reading;
                     reading.threshold = 0.5;
                     const MaskPicture picture = readMaskPicture(path, reading);
                     const auto pixels = static_cast<std::size_t>(picture.mask.width) *
                                         static_cast<std::size_t>(picture.mask.height);
                     if (picture.mask.samples.size() != pixels) std::abort();
                   });
  return 0;
}
