#pragma once

#include <cstdlib>
#include <string_view>

namespace gnomon::test {

/// How often a test of faults repeats what it tries: `shortCount` in `./gnomon test`, `longCount`
/// in `./gnomon test --long`, which sets GNOMON_LONG_TESTS=1.
inline int repetitions(int shortCount, int longCount) {
  const char* length = std::getenv("GNOMON_LONG_TESTS");
  return length != nullptr && std::string_view(length) == "1" ? longCount : shortCount;
}

}  // namespace gnomon::test
