// Any bytes as a method's GLSL file with its declaration.

#include "fuzz/reader_fuzz.h"
#include "render/method.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  gnomon::test::fuzzReader(data, size, ".glsl", [](const std::filesystem::path& path) {
    gnomon::render::readMethod(path);
  });
  return 0;
}
