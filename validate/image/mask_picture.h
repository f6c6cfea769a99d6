#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "common/mask.h"
#include "image/images.h"

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
/// integers the grey to within 10⁻⁵, too.
/// @throws InputError as `readGreyPicture`; for a value that is not finite, threshold or not; and,
///   without a threshold, for any other value: with their number and the first one's place
MaskPicture readMaskPicture(const std::filesystem::path& file, const MaskReading& reading = {});

/// A map of visibility as a PNG of 16-bit greys: V times 65,535, rounded; no sample is 32,896,
/// which is Gnomon's grey of masks, 128/255. A share that would be rounded to that is written as
/// 32,895. Same map, same bytes.
/// @throws InternalError as pngOf
std::string sharePng(const Visibility& map);

/// The same as the bytes of an EXR of 32-bit floats: `V`, and the alpha `A`, 0 where there is no
/// sample.
std::string shareExr(const Visibility& map);

/// Reads a map of visibility that any renderer wrote, or a mask as one of zeros and ones: values of
/// 0 to 1 are V; alpha 0, or 128/255 to within 10⁻⁵, is no sample.
/// @param reading  its channel, `inverted` (values are 1 - V) and `upward`; it has no threshold
/// @throws InputError as `readGreyPicture`; for a value that is not finite or not 0 to 1, and for a
///   partial alpha, with its place
Visibility readSharePicture(const std::filesystem::path& file, const MaskReading& reading = {});

/// Whether a picture of a mask holds shares: values between those of a mask, in more than 8 bits.
/// In 8 bits they are taken for the smoothed edges of a mask.
/// @throws InputError as `readGreyPicture`
bool holdsShares(const std::filesystem::path& file, const MaskReading& reading = {});

/// Where a candidate differs from the truth, by how much and in which direction: from the grey
/// between DifferenceColours' bothShadowed and bothLit that V_truth says toward falseShadow or
/// falseLight as |V - V_truth| goes from 0 to 1. Of zeros and ones it is the masks'
/// differenceImage.
/// @throws InputError if the sizes differ or only one of the two has a sample somewhere
Image shareDifferenceImage(const Visibility& candidate, const Visibility& truth);

/// The candidate's shares in a file of such a picture: zeros and ones as they are, others to 0.02
/// where they differ from the truth by at most a half, else to 0.1: its colours have 8 bits.
/// @throws InputError as `readGreyPicture`, and for a colour that no such picture has
Visibility sharesOfDifference(const std::filesystem::path& file);

}  // namespace gnomon::image
