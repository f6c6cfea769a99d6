#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "image/picture_meaning.h"

namespace gnomon::image {

/// One channel of a picture as numbers, row by row from the top.
struct GreyPicture {
  int width = 0;
  int height = 0;
  std::vector<float> values;
  std::vector<float> alphas;  ///< a mask's coverage, 0 to 1; empty where it is 1 everywhere
  int integerBits = 0;        ///< 8 or 16 of a picture of such integers, else 0
};

/// Which channel of a picture: by name, by number from 0, or the only one.
struct PictureChannel {
  std::string name;
  std::optional<int> index;
};

/// Reads a picture of any format of `ImageFormat`: integers of up to 16 bits as shares of their
/// largest value, all other numbers as they stand in the file. What else the file says of its
/// pixels is treated as `meaningTable` has it.
///
/// The channel is the one named, in whichever part of the file it is, or the one of that number in
/// the first part: without alpha. Without either it is the first part's: its only channel beside
/// alpha, or its three where they are equal; values that the file holds multiplied by alpha are
/// divided by it, where that is not 0.
///
/// The picture is the file's display window.
/// @throws InputError naming the file: missing, of another format, unreadable, deep or of several
///   layers of depth, refused by the table, no such channel, no channel that is the one, or three
///   that differ (naming the first pixel); MemoryError where it would not fit
GreyPicture readGreyPicture(const std::filesystem::path& path, const PictureChannel& channel,
                            PictureUse use);

/// A mask's, by name.
inline GreyPicture readGreyPicture(const std::filesystem::path& path,
                                   const std::string& channel = {}) {
  return readGreyPicture(path, {channel, {}}, PictureUse::mask);
}

}  // namespace gnomon::image
