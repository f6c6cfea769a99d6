#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "image/image_file.h"

namespace gnomon::image {

/// What a picture is read for.
enum class PictureUse { heights, mask, method };

/// What is done about something that a file says of its pixels.
enum class Decision { asStored, honoured, refused };

/// What a file may say that changes the meaning of its pixels.
enum class Meaning {
  orientation,
  rowOrder,
  colourModel,
  whiteZeroInteger,
  whiteZeroOther,
  palette,
  fewBits,
  wideIntegers,
  scale,
  wideFloats,
  otherNumbers,
  colourSpace,
  largerWindow,
  smallerWindow,
  noData,
  multipliedAlpha,
  alpha,
  differentChannels,
  parts,
  otherPage,
  density,
};

/// A decision, and in a few words how it is carried out.
struct MeaningCell {
  Decision decision = Decision::asStored;
  std::string_view how = {};
};

/// A row of the table that all readers of pictures follow.
struct MeaningRow {
  Meaning meaning;
  std::string_view name;            ///< for the manual
  std::array<MeaningCell, 3> uses;  ///< by PictureUse
};

/// The table: one row for each Meaning, in their order.
const std::array<MeaningRow, 21>& meaningTable();

bool isRefused(Meaning meaning, PictureUse use);

/// The table as the manual has it, in Markdown.
std::string meaningTableText();

/// Whether a number that was read of a channel is the file's for "no data".
bool holdsNoData(const ImageFacts& facts, int channel, float value);
/// That it is, for a refusal.
std::string noDataSentence(const ImageFacts& facts, int column, int row);

/// Refuses the part that an image has gone to, before anything of it is decoded: what its facts say
/// against the table, what ImageFile::requireReadable refuses, and a display window that does not
/// fit into memory.
/// @param bytesKept  what the caller will hold of each pixel of the display window
/// @throws InputError, MemoryError
void requireMeaning(const ImageFile& image, PictureUse use, double bytesKept);

/// Puts the last row first, and so on.
template <typename Value>
void flipRows(std::vector<Value>& values, int width) {
  const std::ptrdiff_t step = width;
  auto low = values.begin();
  auto high = values.end() - step;
  for (; low < high; low += step, high -= step) std::swap_ranges(low, low + step, high);
}

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
/// the first part: without alpha. Without either it is the first part's: its only channel apart
/// from alpha, or its three where they are equal; values that the file holds multiplied by alpha
/// are divided by it, where that is not 0.
///
/// The picture is the file's display window.
/// @throws InputError naming the file: missing, of another format, unreadable, deep or of several
///   layers of depth, refused by the table, no such channel, no channel that is the one, or three
///   that differ (naming the first pixel); MemoryError where it would not fit
GreyPicture readGreyPicture(const std::filesystem::path& file, const PictureChannel& channel,
                            PictureUse use);

/// A mask's, by name.
inline GreyPicture readGreyPicture(const std::filesystem::path& file,
                                   const std::string& channel = {}) {
  return readGreyPicture(file, {channel, {}}, PictureUse::mask);
}

}  // namespace gnomon::image
