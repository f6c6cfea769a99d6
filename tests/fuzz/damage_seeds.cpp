// Where libFuzzer does not search, a fuzz target still gets its seeds: whole, cut off in many
// places, and with single bytes changed, the same each time. A target ends the process where a
// reader neither takes nor refuses an input in one line.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "common/files/atomic_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

void give(const std::string& bytes) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

void giveDamaged(const std::string& seed) {
  constexpr std::size_t cuts = 100;
  constexpr int changes = 200;
  give(seed);
  const std::size_t stride = std::max<std::size_t>(1, seed.size() / cuts);
  for (std::size_t size = 0; size < seed.size(); size += stride) give(seed.substr(0, size));
  std::mt19937 random(1);
  for (int i = 0; i < changes && !seed.empty(); ++i) {
    std::string changed = seed;
    changed[random() % seed.size()] = static_cast<char>(random() % 256);
    give(changed);
  }
}

}  // namespace

int main(int count, char** arguments) {
  int seeds = 0;
  for (int i = 1; i < count; ++i) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(arguments[i])) {
      files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    for (const std::filesystem::path& file : files) {
      giveDamaged(gnomon::readFile(file));
      ++seeds;
    }
  }
  std::printf("%d seeds\n", seeds);
  return seeds > 0 ? 0 : 1;
}
