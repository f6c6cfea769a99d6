#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <vector>

namespace gnomon {

/// The label that a `[[method]]` bears, given or by default; empty where it has neither a name nor
/// a file, which whoever reads the study refuses.
std::string methodLabel(const toml::table& method);

/// Puts other shaders in the place of a study's methods: its thresholds, claims and references then
/// judge them, since the label stays. A replaced method keeps its own table's overrides of bake,
/// base and filter; its parameters go, as they are those of the shader that it had, and so does its
/// ladder.
/// @param study         as parsed
/// @param file          the study's, for messages
/// @param replacements  `LABEL=NAME`, NAME a built-in method, or `LABEL=FILE.glsl`, a path relative
///   to the current folder
/// @throws UsageError for a text without `=`, a label that no method of the study bears, or one
///   that is replaced twice
void replaceMethods(toml::table& study, const std::filesystem::path& file,
                    const std::vector<std::string>& replacements);

}  // namespace gnomon
