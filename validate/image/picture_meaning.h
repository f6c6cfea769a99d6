#pragma once

#include <array>
#include <string>
#include <string_view>

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

}  // namespace gnomon::image
