#pragma once

#include <fmt/core.h>

#include <string_view>

#include "common/error.h"

namespace gnomon::study {

template <typename AnyError>
[[noreturn]] void rethrowWithKey(const AnyError& error, std::string_view section) {
  if (error.parameter().empty()) throw;
  throw AnyError(error.reason(), fmt::format("{}.{}", section, error.parameter()));
}

/// Calls a library with values of a study's section. Where the library's error names a parameter,
/// the error that leaves here names the section's key of the same name: `truth.step` for `step`.
/// @return what `work` returns
template <typename Work>
auto withKeys(std::string_view section, const Work& work) -> decltype(work()) {
  try {
    return work();
  } catch (const InputError& error) {
    rethrowWithKey(error, section);
  } catch (const MemoryError& error) {
    rethrowWithKey(error, section);
  }
}

}  // namespace gnomon::study
