#pragma once

#include <filesystem>
#include <string>

namespace gnomon::study {

/// The text of a study. A command reads it once, since a pipe can be read only once, and so that
/// everything in a run comes from the same text.
struct StudyText {
  std::filesystem::path file;  ///< as the command line names it
  std::string text;
};

/// Reads a study's file, or the pipe that /dev/stdin or the like stands for.
/// @throws InputError as readFileOrStream
StudyText readStudyText(const std::filesystem::path& file);

/// Where a study's relative paths begin: the folder of its file. One that comes from a stream has
/// none, so that they begin at the working directory.
std::filesystem::path studyFolder(const std::filesystem::path& file);

}  // namespace gnomon::study
