// Any bytes as a study file.

#include "fuzz/reader_fuzz.h"
#include "study/spec/sweep/sweep.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  gnomon::test::fuzzReader(data, size, ".toml", [](const std::filesystem::path& path) {
    gnomon::study::StudyOptions options;
    options.mostCases = 20;  // each of which is read
    gnomon::study::readStudyPlan(path, options);
  });
  return 0;
}
