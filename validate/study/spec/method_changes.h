#pragma once

#include <fmt/core.h>
#include <toml++/toml.h>

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/error.h"
#include "study/spec/study_file.h"

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

/// Removes the methods that command-line options exclude, with the gates, claims and ladders that
/// name them; in the quick form also the gates of the full form alone. `leftOut` and
/// `leftOutMethods` list what was removed.
/// @throws UsageError for a method that the study does not have
void reduce(StudySpec& study, const StudyOptions& options);

/// The study without some of its methods, and without the gates, claims and ladders that name them.
StudySpec withoutMethods(StudySpec study, std::span<const std::string> labels);

}  // namespace gnomon::study
