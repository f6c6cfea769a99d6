#pragma once

namespace gnomon::test {

/// Whether a sanitizer's own memory counts in what this process holds, whose peak then tells
/// nothing of the program.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool isSanitized = true;
#else
constexpr bool isSanitized = false;
#endif

}  // namespace gnomon::test
