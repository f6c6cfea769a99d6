#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <png.h>

#include <cmath>
#include <random>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "image/formats/exif_orientation.h"
#include "image/image_file.h"
#include "support/error_messages.h"
#include "support/temporary_folder.h"

namespace gnomon::image {
namespace {

using ::testing::HasSubstr;
using namespace std::string_literals;

/// A kind of PNG that libpng can write.
struct PngKind {
  int colours;  ///< PNG_COLOR_TYPE_…
  int bits;
  int interlacing;
  bool isTransparent;  ///< with a tRNS chunk
};

class Pngs : public TemporaryFolder {
 protected:
  static constexpr int width_ = 37;
  static constexpr int height_ = 131;

  /// Writes random numbers by libpng's own calls.
  void writePng(const PngKind& kind) const {
    std::FILE* out = std::fopen(file("p.png").c_str(), "wb");
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, out);
    png_set_IHDR(png, info, width_, height_, kind.bits, kind.colours, kind.interlacing,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    std::mt19937 random(3);
    std::array<png_color, 16> palette{};
    for (png_color& colour : palette) {
      colour = {static_cast<png_byte>(random()), static_cast<png_byte>(random()),
                static_cast<png_byte>(random())};
    }
    const auto entries = static_cast<std::size_t>(1 << std::min(kind.bits, 4));
    if (kind.colours == PNG_COLOR_TYPE_PALETTE) {
      png_set_PLTE(png, info, palette.data(), static_cast<int>(entries));
    }
    std::array<png_byte, 2> shares = {0, 128};
    png_color_16 clear{0, 1, 1, 1, 1};
    if (kind.isTransparent) png_set_tRNS(png, info, shares.data(), 2, &clear);
    png_write_info(png, info);
    const int passes = png_set_interlace_handling(png);
    std::vector<std::vector<png_byte>> rows(height_,
                                            std::vector<png_byte>(png_get_rowbytes(png, info)));
    for (auto& row : rows) {
      for (png_byte& value : row) value = static_cast<png_byte>(random());
      // Indices of 8 bits have to be in the palette.
      if (kind.colours != PNG_COLOR_TYPE_PALETTE || kind.bits < 8) continue;
      for (png_byte& value : row) value = static_cast<png_byte>(value % entries);
    }
    for (int pass = 0; pass < passes; ++pass) {
      for (auto& row : rows) png_write_row(png, row.data());
    }
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    std::fclose(out);
  }

  /// Every number of the picture, as shares.
  std::vector<float> readByUs() const {
    ImageFile image(file("p.png"));
    const int channels = image.facts().channelCount();
    std::vector<float> values;
    image.readPlaced(0, channels, [&](const float* pixels, int, int, int count) {
      values.insert(values.end(), pixels, pixels + count * channels);
    });
    return values;
  }
};

TEST_F(Pngs, AreReadAsAnotherLibraryReadsThem) {
  int kinds = 0;
  for (const auto& [colours, depths] :
       std::vector<std::pair<int, std::vector<int>>>{{PNG_COLOR_TYPE_GRAY, {1, 2, 4, 8, 16}},
                                                     {PNG_COLOR_TYPE_RGB, {8, 16}},
                                                     {PNG_COLOR_TYPE_PALETTE, {1, 2, 4, 8}},
                                                     {PNG_COLOR_TYPE_GRAY_ALPHA, {8, 16}},
                                                     {PNG_COLOR_TYPE_RGB_ALPHA, {8, 16}}}) {
    for (const int bits : depths) {
      for (const int interlacing : {PNG_INTERLACE_NONE, PNG_INTERLACE_ADAM7}) {
        for (const bool isTransparent : {false, true}) {
          if (isTransparent && (colours & PNG_COLOR_MASK_ALPHA) != 0) continue;
          SCOPED_TRACE(testing::Message() << colours << " " << bits << " " << interlacing);
          writePng({colours, bits, interlacing, isTransparent});
          OIIO::ImageSpec wishes;
          wishes.attribute("oiio:UnassociatedAlpha", 1);
          const auto theirs = OIIO::ImageInput::open(file("p.png").string(), &wishes);
          ASSERT_TRUE(theirs) << OIIO::geterror();
          const OIIO::ImageSpec& spec = theirs->spec();
          std::vector<float> expected(spec.image_pixels() *
                                      static_cast<std::size_t>(spec.nchannels));
          ASSERT_TRUE(
              theirs->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, expected.data()));
          const ImageFacts facts = ImageFile(file("p.png")).facts();
          EXPECT_EQ(facts.channels, spec.channelnames);
          EXPECT_EQ(facts.alpha, spec.alpha_channel);
          EXPECT_EQ(facts.channelNumbers.front(), spec.format.c_str());
          EXPECT_EQ(facts.bytesAPixel, static_cast<double>(spec.pixel_bytes(true)));
          EXPECT_EQ(readByUs(), expected);
          ++kinds;
        }
      }
    }
  }
  EXPECT_EQ(kinds, 52);
}

TEST_F(Pngs, ADamagedOneIsOneLineAndNothingIsPrinted) {
  writePng({PNG_COLOR_TYPE_GRAY, 16, PNG_INTERLACE_NONE, false});
  const std::string whole = readFile(file("p.png"));
  ASSERT_EQ(readByUs().size(), static_cast<std::size_t>(width_ * height_));
  std::mt19937 random(8);
  testing::internal::CaptureStderr();
  int refused = 0;
  const std::size_t nearEnd = whole.size() - 40;
  for (std::size_t size = 8; size < whole.size(); size += size < nearEnd ? 97 : 1) {
    writeTextAtomically(file("p.png"), whole.substr(0, size));
    EXPECT_THAT(messageOf<InputError>([&] { readByUs(); }), HasSubstr("p.png: ")) << size;
  }
  for (int i = 0; i < 200; ++i) {
    std::string changed = whole;
    changed[8 + random() % (whole.size() - 8)] ^= static_cast<char>(1U << (random() % 8));
    writeTextAtomically(file("p.png"), changed);
    try {
      readByUs();
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      ++refused;
    }
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  // All but a changed checksum of a part that is not needed.
  EXPECT_GT(refused, 190);
}

TEST(ExifOrientation, IsReadInBothByteOrders) {
  const auto orientation = [](const std::string& exif) {
    return exifOrientation({reinterpret_cast<const std::uint8_t*>(exif.data()), exif.size()});
  };
  const std::string little =
      "II*\0\x08\0\0\0\x02\0"
      "\x0f\x01\x02\0\x01\0\0\0A\0\0\0"
      "\x12\x01\x03\0\x01\0\0\0\x06\0\0\0"s;
  EXPECT_EQ(orientation(little), 6);
  EXPECT_EQ(orientation("MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x08\0\0"s), 8);
  EXPECT_EQ(orientation(""), 1);
  for (std::size_t size = 0; size < little.size() - 4; ++size) {
    EXPECT_EQ(orientation(little.substr(0, size)), 1) << size;
  }
}

TEST_F(Pngs, TellHowTheyAreTurned) {
  writePng({PNG_COLOR_TYPE_GRAY, 8, PNG_INTERLACE_NONE, false});
  // A chunk eXIf behind IHDR, with the checksum that libpng asks for.
  const std::string exif = "eXIfMM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x06\0\0"s;
  const auto big = [](std::uint32_t value) {
    std::string bytes;
    for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(value >> shift);
    return bytes;
  };
  std::uint32_t sum = ~0U;
  for (const char c : exif) {
    sum ^= static_cast<std::uint8_t>(c);
    for (int bit = 0; bit < 8; ++bit) sum = sum & 1 ? sum >> 1 ^ 0xedb88320U : sum >> 1;
  }
  std::string bytes = readFile(file("p.png"));
  bytes.insert(33, big(static_cast<std::uint32_t>(exif.size() - 4)) + exif + big(~sum));
  writeTextAtomically(file("p.png"), bytes);
  EXPECT_EQ(ImageFile(file("p.png")).facts().orientation, 6);
}

}  // namespace
}  // namespace gnomon::image
