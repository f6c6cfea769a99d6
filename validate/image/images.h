#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>

#include "common/mask.h"
#include "image/image.h"

namespace gnomon::image {

using Rgb = std::array<std::uint8_t, 3>;

/// The greys of a mask picture. Exact, so that a mask can be read back: see mask_picture.h.
struct MaskGreys {
  static constexpr std::uint8_t lit = 255;
  static constexpr std::uint8_t shadowed = 0;
  static constexpr std::uint8_t none = 128;
};

/// The colours of a signed difference. Agreement is grey, errors are orange and blue: a pair that
/// the common colour vision deficiencies keep apart, and close in lightness, so that neither kind
/// of error looks like the larger one. The report's legend and bars use the same constants.
struct DifferenceColours {
  static constexpr Rgb falseShadow{230, 97, 0};
  static constexpr Rgb falseLight{26, 133, 255};
  static constexpr Rgb bothLit{226, 226, 226};
  static constexpr Rgb bothShadowed{92, 92, 92};
  static constexpr Rgb none{255, 255, 255};
};

/// A mask as a picture.
/// @throws InternalError if the mask's samples do not fill its width × height
ByteImage maskImage(const Mask& mask);

/// Where a candidate differs from the truth, and in which direction.
/// @throws InputError if the sizes differ or only one of the two has a sample somewhere
Image differenceImage(const Mask& candidate, const Mask& truth);

/// An image as the bytes of a PNG. Same image, same bytes. By libpng itself: a run that only writes
/// pictures need not load OpenImageIO.
/// @throws InternalError for an image without pixels or over 10⁶ of them a side, and for one whose
///   values do not fill its width × height
std::string pngOf(const Image& image);
std::string pngOf(const ByteImage& image);
std::string pngOf(const GreyImage& image);

/// Writes that PNG, whole or not at all.
/// @throws InputError when the file cannot be written, InternalError as pngOf
void writePng(const std::filesystem::path& path, const Image& image);
void writePng(const std::filesystem::path& path, const ByteImage& image);

}  // namespace gnomon::image
