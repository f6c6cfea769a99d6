#include "image/image_format.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace gnomon::image {
namespace {

using namespace std::string_literals;

TEST(ImageFormats, AreToldByTheirFirstBytes) {
  const std::vector<std::pair<std::string, ImageFormat>> starts = {
      {"\x76\x2f\x31\x01\x02\0\0\0"s, ImageFormat::exr},
      {"\x89PNG\r\n\x1a\n\0\0"s, ImageFormat::png},
      {"II*\0\x08\0\0\0"s, ImageFormat::tiff},
      {"MM\0*\0\0\0\x08"s, ImageFormat::tiff},
      {"II+\0\x08\0"s, ImageFormat::tiff},
      {"\xff\xd8\xff\xe0"s, ImageFormat::jpeg},
      {"#?RADIANCE\n"s, ImageFormat::hdr},
      {"P1\n2 2\n"s, ImageFormat::pnm},
      {"P6#a\n"s, ImageFormat::pnm},
      {"Pf\n2 1\n"s, ImageFormat::pfm},
      {"PF 2 1\n"s, ImageFormat::pfm},
      {"BM\x36\0"s, ImageFormat::bmp},
      // Grey of 8 bits, 3 × 2; colours of 24 bits, packed.
      {"\0\0\x03\0\0\0\0\0\0\0\0\0\x03\0\x02\0\x08\0"s, ImageFormat::tga},
      {"\0\0\x0a\0\0\0\0\0\0\0\0\0\x03\0\x02\0\x18\x20"s, ImageFormat::tga}};
  for (const auto& [start, format] : starts) {
    const auto found = imageFormatOf(start);
    ASSERT_TRUE(found) << start;
    EXPECT_EQ(nameOf(*found), nameOf(format)) << start;
  }
}

TEST(ImageFormats, OthersAreCalledByTheirNames) {
  const std::vector<std::pair<std::string, std::string>> starts = {
      {"", "an empty file"},
      {"GIF89a", "a GIF picture"},
      {"\x53\x80\xf6\x34"s, "a Softimage picture"},
      {"FOR4\0\0", "an IFF picture"},
      {"\x01\xda\x01\x01"s, "an SGI picture"},
      {"8BPS\0\x01"s, "a Photoshop picture (PSD)"},
      {"RIFF\x10\0\0\0WEBPVP8 "s, "a WebP picture"},
      {"SDPX\0\0"s, "a DPX picture"},
      {"SIMPLE  =      T", "a FITS picture"},
      {"\0\0\0\x0cjP  \r\n"s, "a JPEG 2000 picture"},
      {std::string(26, '\0') + "\xff\xfe" + std::string(36, '\0'), "an RLA picture"},
      {"\0\0\x01\0\x01\0\x10\x10\0\0\x01\0\x20\0\x68\x04\0\0"s, "an icon (ICO)"},
      {"P7\nWIDTH 2\n", "a PAM picture"},
      {"P9\n3 3\n", "a file of an unknown kind"},
      {"this is no picture", "a file of an unknown kind"},
      {"\0\x01\x01\0\0\x02\0\x18\0\0\0\0\x03\0\x02\0\x08\0"s, "a TGA with a colour map"},
      // Nearly a TGA: a kind of picture, a depth and a side that there are not.
      {"\0\0\x04\0\0\0\0\0\0\0\0\0\x03\0\x02\0\x08\0"s, "a file of an unknown kind"},
      {"\0\0\x02\0\0\0\0\0\0\0\0\0\x03\0\x02\0\x09\0"s, "a file of an unknown kind"},
      {"\0\0\x02\0\0\0\0\0\0\0\0\0\0\0\x02\0\x18\0"s, "a file of an unknown kind"}};
  for (const auto& [start, kind] : starts) {
    EXPECT_FALSE(imageFormatOf(start)) << kind;
    EXPECT_EQ(otherFileKind(start), kind);
  }
}

TEST(ImageFormats, AStartCutOffAnywhereIsNoOtherFormat) {
  const std::string png = "\x89PNG\r\n\x1a\n"s;
  for (std::size_t size = 0; size < png.size(); ++size) {
    EXPECT_FALSE(imageFormatOf(png.substr(0, size))) << size;
  }
}

}  // namespace
}  // namespace gnomon::image
