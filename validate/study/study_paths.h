#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <string>

namespace gnomon {

/// The way to a file from a folder: relative, with `/`.
std::string pathFrom(const std::filesystem::path& file, const std::filesystem::path& folder);

/// Rewrites a path of a table that is relative to `from` as one relative to `to`. An absolute one,
/// and a key that is not there or holds no text, stay as they are.
void movePath(toml::table& table, const char* key, const std::filesystem::path& from,
              const std::filesystem::path& to);

/// Rewrites likewise all paths of a study's file: the relief's image, the surface's mesh, and the
/// shader files of methods, ladders and their rungs.
void movePaths(toml::table& study, const std::filesystem::path& from,
               const std::filesystem::path& to);

}  // namespace gnomon
