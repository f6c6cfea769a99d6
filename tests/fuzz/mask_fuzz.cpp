// Any bytes as a mask picture of another renderer. The bits of the first byte choose how it is
// read.

#include "fuzz/reader_fuzz.h"
#include "image/mask_picture.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gnomon;
  if (size == 0) return 0;
  image::MaskReading reading;
  if ((data[0] & 1) != 0) reading.threshold = 0.5;
  if ((data[0] & 2) != 0) reading.channel = "A";
  reading.inverted = (data[0] & 4) != 0;
  reading.upward = (data[0] & 8) != 0;
  test::fuzzReader(data + 1, size - 1, ".picture", [&](const std::filesystem::path& path) {
    const image::MaskPicture picture = image::readMaskPicture(path, reading);
    const auto pixels = static_cast<std::size_t>(picture.mask.width) *
                        static_cast<std::size_t>(picture.mask.height);
    if (picture.mask.samples.size() != pixels) std::abort();
  });
  return 0;
}
