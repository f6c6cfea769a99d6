#include <OpenImageIO/imageio.h>
#include <fcntl.h>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <png.h>
#include <unistd.h>

#include <array>
#include <bit>
#include <cmath>
#include <fstream>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "image/formats/picture_headers.h"
#include "image/grey_picture.h"
#include "image/image_file.h"
#include "image/image_format.h"
#include "image/image_module.h"
#include "image/images.h"
#include "image/mask_picture.h"
#include "support/error_messages.h"
#include "support/image_files.h"
#include "support/temporary_folder.h"
#include "support/tiff_files.h"

namespace gnomon::image {
namespace {

using ::testing::HasSubstr;

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

class ImageFiles : public TemporaryFolder {
 protected:
  ImageFiles() { std::iota(values_.begin(), values_.end(), 0.0F); }

  /// 3 × 4 pixels of two channels, 0, 1, 2 … in one row after the other.
  void writeCounting(NumberType numbers) const {
    writeExr(path(), {3, 4, {"b", "a"}, numbers, attributes()}, counting());
  }
  [[nodiscard]] ImageRows counting() const {
    return {NumberType::float32, 3, [&](int top, int) { return values_.data() + 6 * top; }};
  }

  static ImageAttributes attributes() {
    return {{"test:count", 7}, {"test:share", 0.25F}, {"test:name", std::string("columns")}};
  }
  [[nodiscard]] std::filesystem::path path() const { return file("counting.exr"); }

  std::array<float, 24> values_{};
};

TEST_F(ImageFiles, TellsWhatItHolds) {
  writeCounting(NumberType::half);
  const ImageFacts facts = ImageFile(path()).facts();
  EXPECT_EQ(facts.data.width, 3);
  EXPECT_EQ(facts.data.height, 4);
  EXPECT_EQ(facts.display.height, 4);
  EXPECT_EQ(facts.depth, 1);
  EXPECT_EQ(facts.channelCount(), 2);
  EXPECT_GE(facts.channel("a"), 0);
  EXPECT_GE(facts.channel("b"), 0);
  EXPECT_EQ(facts.channel("c"), -1);
  EXPECT_EQ(facts.channelNumbers, std::vector<std::string>(2, nameOf(NumberType::half)));
  EXPECT_EQ(facts.coding, "zip");
  EXPECT_EQ(facts.bytesAPixel, 4);
  const auto another = OIIO::ImageInput::open(path().string());
  ASSERT_TRUE(another);
  EXPECT_EQ(another->spec().get_int_attribute("test:count"), 7);
  EXPECT_EQ(another->spec().get_float_attribute("test:share"), 0.25F);
  EXPECT_EQ(another->spec().get_string_attribute("test:name"), "columns");
}

TEST_F(ImageFiles, GivesBackWhatWasWritten) {
  writeCounting(NumberType::float32);
  ImageFile image(path());
  const int b = image.facts().channel("b");
  std::vector<float> values;
  image.readPlaced(b, b + 1, [&](const float* pixels, int column, int row, int count) {
    EXPECT_EQ(column, 0);
    EXPECT_EQ(values.size(), static_cast<std::size_t>(3 * row));
    values.insert(values.end(), pixels, pixels + count);
  });
  ASSERT_EQ(values.size(), 12U);
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_EQ(values[i], 2 * i);

  // From the top again, row after row.
  ASSERT_TRUE(image.goTo(0));
  std::array<float, 6> row{};
  for (int y = 0; y < 3; ++y) image.readRows(1, 0, 2, row.data());
  EXPECT_EQ(row[static_cast<std::size_t>(b)], 12);
  EXPECT_EQ(row[static_cast<std::size_t>(2 + b)], 14);
}

TEST_F(ImageFiles, HasPartsUpToItsLast) {
  writeCounting(NumberType::uint32);
  ImageFile image(path());
  EXPECT_TRUE(image.goTo(0));
  EXPECT_FALSE(image.goTo(1));
}

TEST_F(ImageFiles, IsTheSameBytesAgain) {
  const auto content = [&] {
    std::ifstream in(path(), std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  writeCounting(NumberType::float32);
  const std::string first = content();
  EXPECT_FALSE(first.empty());
  writeCounting(NumberType::float32);
  EXPECT_EQ(content(), first);
  // So are the bytes that are asked for without a file.
  const ExrDescription exr{3, 4, {"b", "a"}, NumberType::float32, attributes()};
  EXPECT_EQ(imageModule().writeExr({}, exr, counting()), first);
}

TEST_F(ImageFiles, ThatIsMissingOrDamagedIsAnError) {
  EXPECT_THROW(ImageFile(file("missing.png")), InputError);
  const int closed = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  ::close(closed);
  EXPECT_THROW((void)imageModule().writeExr(closed, {3, 4, {"b", "a"}, {}, {}}, counting()),
               ImageError);
  writeCounting(NumberType::float32);
  std::filesystem::resize_file(path(), std::filesystem::file_size(path()) - 20);
  ImageFile image(path());
  std::vector<float> values(24);
  EXPECT_THROW(image.readRows(4, 0, 2, values.data()), InputError);
}

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
