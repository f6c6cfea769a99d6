#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "common/mask.h"
#include "image/image_module.h"

namespace gnomon::image {

/// Red, green and blue of 8 bits, sRGB.
using Rgb = std::array<std::uint8_t, 3>;

/// A picture of 8-bit sRGB values: three a pixel, row by row, row 0 at the top.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;
};

/// A picture of 8-bit greys, row by row, row 0 at the top.
struct ByteImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> values;
};

/// A picture of few colours: the place of each pixel's in a list, row by row, row 0 at the top.
struct PaletteImage {
  int width = 0;
  int height = 0;
  std::vector<Rgb> colours;  ///< at most 256
  std::vector<std::uint8_t> values;
};

/// A picture of 16-bit greys, row by row, row 0 at the top.
struct GreyImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint16_t> values;
};

/// A picture of any number of channels of 32-bit floats.
struct ChannelImage {
  int width = 0;
  int height = 0;
  std::vector<std::string> channels;  ///< their names, as "point.X"
  std::vector<float> values;          ///< those of a pixel beside each other, rows from the top
};

/// Writes an EXR, whole or not at all. Same numbers, same bytes.
/// @throws InputError when the file cannot be written
void writeExr(const std::filesystem::path& file, const ExrDescription& description,
              const ImageRows& rows);

/// Likewise, of floats.
/// @param attributes  names and texts for the file's header
/// @throws InternalError also, for values that do not fill the picture
void writeExr(const std::filesystem::path& file, const ChannelImage& image,
              const ImageAttributes& attributes = {});

/// The bytes of that file.
/// @throws InternalError likewise, and where the image cannot be encoded
std::string exrBytes(const ChannelImage& image);

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
PaletteImage differenceImage(const Mask& candidate, const Mask& truth);

/// The same picture with its colours written out.
Image unfolded(const PaletteImage& image);

/// An image as the bytes of a PNG. Same image, same bytes. By libpng itself: a run that only writes
/// pictures need not load OpenImageIO.
/// @throws InternalError for an image without pixels or over 10⁶ of them a side, for one whose
///   values do not fill its width × height, and for a palette without colours or with over 256
std::string pngOf(const Image& image);
std::string pngOf(const ByteImage& image);
std::string pngOf(const PaletteImage& image);
std::string pngOf(const GreyImage& image);

/// Writes that PNG, whole or not at all.
/// @throws InputError when the file cannot be written, InternalError as pngOf
void writePng(const std::filesystem::path& file, const Image& image);
void writePng(const std::filesystem::path& file, const ByteImage& image);
void writePng(const std::filesystem::path& file, const PaletteImage& image);

/// Pictures as a page embeds them.

/// WebP of a quality at which a shading shows no loss, even enlarged.
constexpr int fineQuality = 95;
/// WebP for a picture that is shown small.
constexpr int smallQuality = 88;
/// Of such a picture: the page shows it at a quarter of its width, on paper at two inches.
constexpr int smallSide = 600;

/// Bytes as the address of a picture: "data:TYPE;base64,…".
std::string dataAddress(std::string_view type, const std::string& bytes);

/// A picture as the bytes of a WebP, with losses. Same image, same bytes. With little effort: the
/// usual one takes 1.4 to 1.9 times as long for shadings 6 % shorter, the utmost yet more for 1 to
/// 3 % of that.
/// @param quality      0 to 100
/// @param longestSide  pixels, at least 1: a longer picture is shrunk to it, each of its new pixels
///   the mean over its area
/// @throws InternalError for a picture without pixels, or with more of them on a side than WebP
///   takes (16,383)
std::string webPicture(const Image& image, int quality,
                       int longestSide = std::numeric_limits<int>::max());

}  // namespace gnomon::image
