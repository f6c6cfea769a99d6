#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "common/mask.h"

namespace gnomon::image {

/// How a picture of a mask is to be understood.
struct MaskReading {
  std::string channel;  ///< as `readGreyPicture`
  std::optional<double>
      threshold;          ///< values of at least this are lit, in a picture with soft ones
  bool inverted = false;  ///< white is shadow
  bool upward = false;    ///< the picture's first row is the lowest
};

/// A mask read from a picture.
struct MaskPicture {
  Mask mask;
  std::size_t binarised = 0;  ///< pixels that only the threshold could decide
};

/// Reads a mask that any renderer wrote: 1 (white) lit, 0 (black) shadowed, 128/255 (Gnomon's grey,
/// to the precision of a half) or alpha 0 no sample. A picture of these alone is taken as it is.
/// One with any other value or a partial alpha needs a threshold; then *every* value is compared
/// with it, the grey too, and only alpha below a half means no sample; in a picture of 16-bit
/// integers the grey to within 10⁻⁵, too (share_picture.h).
/// @throws InputError as `readGreyPicture`; for a value that is not finite, threshold or not; and,
///   without a threshold, for any other value: with their number and the first one's place
MaskPicture readMaskPicture(const std::filesystem::path& path, const MaskReading& reading = {});

}  // namespace gnomon::image
