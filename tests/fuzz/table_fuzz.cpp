// Any bytes as a file of horizon tables.

#include "fuzz/reader_fuzz.h"
#include "horizon/table_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  gnomon::test::fuzzReader(data, size, ".exr",
                           [](const std::filesystem::path& path) { gnomon::readHorizons(path); });
  return 0;
}
