#pragma once

#include <map>
#include <random>
#include <string>
#include <vector>

#include "end_to_end/support/program.h"

namespace gnomon::test {

/// The small study with other names, so that its files are others than the small study's: what is
/// left of one of them beside the other shows.
std::string otherStudy();

/// Files below a folder, relative to it, with their bytes; without the bytes of those that hold
/// times.
using FolderContent = std::map<std::string, std::string>;
FolderContent contentOf(const std::filesystem::path& folder);

/// Names of the files that only one of two folders has, or that differ.
std::vector<std::string> differences(const FolderContent& a, const FolderContent& b);

/// Names of the part files below a folder: see PartFile.
const std::vector<std::string> nothing;
std::vector<std::string> partFilesBelow(const std::filesystem::path& folder);

/// What a folder of results shows.
enum class Shown { whole, notWhole, mixed };

/// Of a folder and those below that have an index (summary.json, truth.json, export.json): `whole`
/// where each is that of one of the runs, byte for byte; `notWhole` where none has an index;
/// `mixed` where one has an index and is no run's.
Shown shownBy(const FolderContent& folder, const std::vector<FolderContent>& wholeRuns);

}  // namespace gnomon::test
