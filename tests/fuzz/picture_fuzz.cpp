// Any bytes that are told as a picture of GNOMON_FUZZ_FORMAT, as a height map: one target a format,
// so that none of them is searched less than the others.

#include <cmath>

#include "fuzz/reader_fuzz.h"
#include "image/image_format.h"
#include "relief/height_field.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gnomon;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (image::imageFormatOf(bytes.substr(0, image::imageStartBytes)) !=
      image::ImageFormat::GNOMON_FUZZ_FORMAT)
    return 0;
  test::fuzzReader(data, size, ".picture", [](const std::filesystem::path& path) {
    const relief::HeightField field = relief::readHeightImage(path, 0, 1, relief::Wrap::repeat);
    if (!std::isfinite(field.at({0.3, 0.7}))) std::abort();
  });
  return 0;
}
