#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "study/spec/study_file.h"

namespace gnomon::study {

/// The masks of a folder by their names: the file's without its extension, and without the `_truth`
/// that an export gives the truth's. Folders, hidden files, and what file managers leave
/// (`Thumbs.db`, `desktop.ini`) are not looked at.
/// @throws InputError for a folder that cannot be read, or two files of one name
std::map<std::string, std::filesystem::path> masksIn(const std::filesystem::path& folder);

/// A mask of a method that another program drew.
struct GivenMaskFile {
  std::size_t view = 0, light = 0;  ///< places in the study
  std::filesystem::path path;
};

/// The masks of a method, one a view and light, the lights of the first view first: those of its
/// folder that are named VIEW_LIGHT, as an export names the truth's. Nothing for a method that runs
/// here.
/// @throws InputError as masksIn, and for a mask that is missing
std::vector<GivenMaskFile> givenMaskFiles(const StudySpec& study, const MethodSpec& method);

}  // namespace gnomon::study
