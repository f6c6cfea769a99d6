#include <fmt/core.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "image/grey_picture.h"
#include "image/image_file.h"
#include "image/mask_picture.h"
#include "support/image_files.h"
#include "support/temporary_folder.h"
#include "support/tiff_files.h"

namespace gnomon::image {
namespace {

class Tiffs : public TemporaryFolder {
 protected:
  static constexpr int side_ = 64;

  /// Writes a deflated TIFF of 8 bits that are noise, which does not shrink.
  [[nodiscard]] std::string deflated(int tileSide) const {
    test::TestPicture picture;
    picture.width = picture.height = side_;
    picture.type = OIIO::TypeDesc::UINT8;
    for (int i = 0; i < side_ * side_; ++i) {
      picture.values.push_back(static_cast<float>((i * 7919) % 251) / 255);
    }
    OIIO::ImageSpec spec = picture.spec();
    spec.attribute("compression", "zip");
    spec.tile_width = spec.tile_height = tileSide;
    test::writePicture(path(), spec, picture.values);
    return readFile(path());
  }
  /// The same file, whose header says that a number has 16 bits.
  static std::string withTwiceTheBits(std::string tiff) {
    const std::string bitsPerSample("\x02\x01\x03\x00\x01\x00\x00\x00\x08", 9);
    const std::size_t found = tiff.find(bitsPerSample);
    EXPECT_NE(found, std::string::npos);
    tiff.at(found + bitsPerSample.size() - 1) = '\x10';
    return tiff;
  }
  void read() const {
    ImageFile image(path());
    image.requireReadable(0);
    std::vector<float> values(static_cast<std::size_t>(side_) * side_);
    image.readRows(side_, 0, 1, values.data());
  }
  [[nodiscard]] std::filesystem::path path() const { return file("map.tif"); }
};

TEST_F(Tiffs, WhoseStripsHoldLessThanTheirRowsAreRefused) {
  for (const int tileSide : {0, 16}) {
    const std::string whole = deflated(tileSide);
    EXPECT_NO_THROW(read());
    writeTextAtomically(path(), withTwiceTheBits(whole));
    EXPECT_THROW(read(), InputError) << "heights that no file holds, tiles of " << tileSide;
  }
}

/// A type of numbers, and what a reader gives for one of them.
struct NumberKind {
  int bits, format;
  double low, high;  ///< of the numbers that a file gets
  double largest;    ///< that a share is of

  /// Spread over all of them; floats in steps that a half holds.
  [[nodiscard]] std::vector<double> numbers(int count) const {
    std::vector<double> found;
    for (int i = 0; i < count; ++i) {
      const double share = (i * 7919 + 13) % 257 / 256.0;
      const double number = low + share * (high - low);
      found.push_back(format == SAMPLEFORMAT_IEEEFP ? number : std::floor(number));
    }
    return found;
  }
};

constexpr std::array kinds = {
    NumberKind{1, SAMPLEFORMAT_UINT, 0, 1, 1},
    NumberKind{2, SAMPLEFORMAT_UINT, 0, 3, 3},
    NumberKind{4, SAMPLEFORMAT_UINT, 0, 15, 15},
    NumberKind{8, SAMPLEFORMAT_UINT, 0, 255, 255},
    NumberKind{10, SAMPLEFORMAT_UINT, 0, 1023, 1023},
    NumberKind{12, SAMPLEFORMAT_UINT, 0, 4095, 4095},
    NumberKind{16, SAMPLEFORMAT_UINT, 0, 65535, 65535},
    NumberKind{32, SAMPLEFORMAT_UINT, 0, 4294967295, 1},
    NumberKind{8, SAMPLEFORMAT_INT, -128, 127, 127},
    NumberKind{16, SAMPLEFORMAT_INT, -32767, 32767, 32767},
    NumberKind{32, SAMPLEFORMAT_INT, -2147483648, 2147483647, 1},
    NumberKind{16, SAMPLEFORMAT_IEEEFP, -8, 8, 1},
    NumberKind{32, SAMPLEFORMAT_IEEEFP, -1000, 9000, 1},
    NumberKind{64, SAMPLEFORMAT_IEEEFP, -1000, 9000, 1},
};

constexpr std::array codings = {COMPRESSION_NONE,     COMPRESSION_LZW,  COMPRESSION_ADOBE_DEFLATE,
                                COMPRESSION_PACKBITS, COMPRESSION_ZSTD, COMPRESSION_LZMA,
                                COMPRESSION_CCITTFAX4};

/// What libtiff writes: predictors take whole bytes, the fax one bit.
bool canWrite(const test::TestTiff& tiff) {
  const bool isPacked = tiff.compression == COMPRESSION_LZW ||
                        tiff.compression == COMPRESSION_ADOBE_DEFLATE ||
                        tiff.compression == COMPRESSION_ZSTD;
  if (tiff.compression == COMPRESSION_CCITTFAX4 && tiff.bits * tiff.samples > 1) return false;
  if (tiff.predictor == PREDICTOR_NONE) return true;
  if (!isPacked) return false;
  return tiff.predictor == PREDICTOR_FLOATINGPOINT
             ? tiff.format == SAMPLEFORMAT_IEEEFP
             : tiff.format != SAMPLEFORMAT_IEEEFP && tiff.bits >= 8 && tiff.bits % 8 == 0;
}

TEST_F(Tiffs, OfEveryTypeLayoutPackingAndOrderOfBytesAreReadAsWritten) {
  constexpr int width = 37;
  constexpr int height = 21;
  int files = 0;
  for (const NumberKind& kind : kinds) {
    for (const int coding : codings) {
      // Bits: tiles, the order of bytes, planes of three channels.
      for (unsigned layout = 0; layout < 24; ++layout) {
        const int predictor = static_cast<int>(layout / 8) + 1;
        test::TestTiff tiff{width, height, kind.bits, kind.format};
        tiff.compression = coding;
        tiff.predictor = predictor;
        tiff.isTiled = (layout & 1U) != 0;
        tiff.isBigEndian = (layout & 2U) != 0;
        tiff.isSeparate = (layout & 4U) != 0;
        if (tiff.isSeparate) {
          tiff.samples = 3;
          tiff.photometric = PHOTOMETRIC_RGB;
        }
        if (!canWrite(tiff)) continue;
        SCOPED_TRACE(fmt::format("{} bits, format {}, coding {}, layout {}", kind.bits, kind.format,
                                 coding, layout));
        const std::vector<double> numbers = kind.numbers(width * height * tiff.samples);
        test::writeTiff(path(), tiff, numbers);
        ++files;
        const int channel = tiff.samples - 1;
        const GreyPicture picture = readGreyPicture(path(), {{}, channel}, PictureUse::heights);
        ASSERT_EQ(picture.values.size(), static_cast<std::size_t>(width * height));
        for (std::size_t i = 0; i < picture.values.size(); ++i) {
          const auto at =
              i * static_cast<std::size_t>(tiff.samples) + static_cast<std::size_t>(channel);
          const double expected = numbers[at] / kind.largest;
          // Two roundings to a float.
          ASSERT_NEAR(picture.values[i], expected, std::abs(expected) * 0x1p-22) << i;
        }
      }
    }
  }
  EXPECT_GT(files, 700);
  fmt::print("{} TIFFs\n", files);
}

TEST_F(Tiffs, OfBytesPutDownByHandHoldDoublesOfBothOrders) {
  for (const bool isBig : {false, true}) {
    std::string bytes = isBig ? "MM" : "II";
    const auto put = [&](std::uint64_t number, int size) {
      for (int i = 0; i < size; ++i) {
        bytes += static_cast<char>(number >> 8 * (isBig ? size - 1 - i : i));
      }
    };
    const auto tag = [&](int number, int type, int value) {
      put(static_cast<std::uint64_t>(number), 2);
      put(static_cast<std::uint64_t>(type), 2);
      put(1, 4);
      put(static_cast<std::uint64_t>(value), type == 3 ? 2 : 4);
      if (type == 3) put(0, 2);
    };
    put(42, 2);
    put(24, 4);
    put(std::bit_cast<std::uint64_t>(-1.5), 8);
    put(std::bit_cast<std::uint64_t>(1.0 / 3), 8);
    put(9, 2);
    for (const auto& [number, type, value] : {std::array{256, 3, 2},
                                              {257, 3, 1},
                                              {258, 3, 64},
                                              {259, 3, 1},
                                              {262, 3, 1},
                                              {273, 4, 8},
                                              {278, 3, 1},
                                              {279, 4, 16},
                                              {339, 3, 3}}) {
      tag(number, type, value);
    }
    put(0, 4);
    writeTextAtomically(path(), bytes);
    EXPECT_EQ(readGreyPicture(path()).values, (std::vector{-1.5F, 1.0F / 3})) << isBig;
  }
}

TEST_F(Tiffs, AreMasksInEveryTypeOfNumbers) {
  const std::vector<double> bits = {1, 0, 0, 1, 1, 0};
  for (const NumberKind& kind : kinds) {
    std::vector<double> numbers = bits;
    for (double& number : numbers) number *= kind.largest;
    const std::vector<Shade> expected = {Shade::lit, Shade::shadowed, Shade::shadowed,
                                         Shade::lit, Shade::lit,      Shade::shadowed};
    for (const bool isBig : {false, true}) {
      test::TestTiff tiff{3, 2, kind.bits, kind.format};
      tiff.isBig = isBig;
      test::writeTiff(path(), tiff, numbers);
      EXPECT_EQ(readMaskPicture(path()).mask.samples, expected) << kind.bits << " " << kind.format;
    }
  }
}

}  // namespace
}  // namespace gnomon::image
