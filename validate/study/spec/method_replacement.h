#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <vector>

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

}  // namespace gnomon::study
