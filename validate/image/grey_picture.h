#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::image {

/// One channel of a picture as numbers, row by row from the top.
struct GreyPicture {
  int width = 0;
  int height = 0;
  std::vector<float> values;
  std::vector<float> alphas;  ///< coverage, 0 to 1; empty where the picture has none: 1 everywhere
  int integerBits = 0;        ///< 8 or 16 of a picture of such integers, else 0
};

/// Reads a picture of any format of `ImageFormat`: integers of 8 and 16 bits as 0 to 1, all
/// other numbers as they stand in the file. No colour space is undone.
///
/// The channel is the one named, in whichever part of the file it is, without alpha. Without a name
/// it is the first part's: its only channel beside alpha, or its three where they are equal; values
/// that the file holds multiplied by alpha are divided by it.
///
/// The picture is the file's display window. Where its data window is smaller, alpha is 0; where it
/// is larger, what lies outside is left out.
/// @throws InputError naming the file: missing, of another format, unreadable, deep or of several
/// layers of depth,
///   turned by its `Orientation`, no such channel, no channel that is the one, or three that differ
///   (naming the first pixel); MemoryError where it would not fit
GreyPicture readGreyPicture(const std::filesystem::path& path, const std::string& channel = {});

}  // namespace gnomon::image
