#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "study/spec/study_file.h"
#include "study/spec/toml_reader.h"

namespace gnomon::study {

/// A path as a study holds it: itself, or, since file names may be any bytes but TOML is UTF-8,
/// `file:` and the bytes with all but letters, digits and `-._~/` percent-encoded (RFC 3986):
/// "file:caf%E9.png".
std::string fileText(const std::filesystem::path& path);

/// The path that fileText wrote, to the byte.
std::filesystem::path fileOf(const std::string& text);

/// The file that a key of a study names, which must be there.
/// @param folder  of the study
/// @throws InputError naming study, line and key of one that is missing
std::filesystem::path namedFile(const TomlReader& section, std::string_view key,
                                const std::filesystem::path& folder);

/// The stem of a file's name as a text: itself, or percent-encoded as in fileText.
std::string stemText(const std::filesystem::path& file);

/// The way to a file from a folder: relative, with `/`, as a study holds it.
std::string relativeFile(const std::filesystem::path& file, const std::filesystem::path& folder);

/// Rewrites a path of a table that is relative to `from` as one relative to `to`. An absolute one,
/// and a key that is not there or holds no text, stay as they are.
void moveFile(toml::table& table, const char* key, const std::filesystem::path& from,
              const std::filesystem::path& to);

/// Rewrites likewise all paths of a study's file: the relief's image, the surface's mesh, the
/// shader files of methods, ladders and their rungs, and the methods' folders of masks.
void moveFiles(toml::table& study, const std::filesystem::path& from,
               const std::filesystem::path& to);

/// Whether a study's name may hold a character, since it names a folder: letters, digits, `-`, `_`,
/// `.`.
bool isNameCharacter(char c);

/// Names as parts of file names: at most some sixty letters, digits, dots and dashes, distinct for
/// distinct indices.
/// @param taken  parts that none of them may become
std::vector<std::string> fileNames(const std::vector<std::string>& names,
                                   std::set<std::string> taken = {});

/// Parts of the names of a run's pictures, in the study's order.
struct CaseNames {
  std::vector<std::string> views, lights, methods;
};
CaseNames caseNames(const StudySpec& study);

}  // namespace gnomon::study
