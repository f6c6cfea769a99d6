#pragma once

#include <fmt/core.h>
#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/error.h"

namespace gnomon::study {

/// The label of a `[[method]]`, given or by default; empty where it has neither a name nor a file,
/// which `readStudy` refuses.
std::string methodLabel(const toml::table& method);

/// Replaces the shaders of methods of a study. Labels stay, so that thresholds, claims and
/// references apply to the new shaders. A replaced method keeps its overrides of bake, base and
/// filter. It loses its parameters, which belong to the old shader, and its ladder.
/// @param study         as parsed
/// @param file          the study's, for messages
/// @param replacements  `LABEL=NAME`, NAME a built-in method, or `LABEL=FILE.glsl`, a path relative
///   to the current folder
/// @throws UsageError for a text without `=`, a label that no method of the study has, or one that
///   is replaced twice
void replaceMethods(toml::table& study, const std::filesystem::path& file,
                    const std::vector<std::string>& replacements);

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
