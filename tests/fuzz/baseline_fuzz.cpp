// Any bytes as the committed reference values of a study. What is taken must be the same when it is
// written and read once more.

#include "common/files/atomic_file.h"
#include "fuzz/reader_fuzz.h"
#include "report/json/results_json.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gnomon;
  test::fuzzReader(data, size, ".json", [](const std::filesystem::path& path) {
    const std::string text = report::baselineJson(report::readBaseline(path));
    writeTextAtomically(path, text);
    if (report::baselineJson(report::readBaseline(path)) != text) std::abort();
  });
  return 0;
}
