// What a file says of its pixels, for every use of a picture: one file or more for each cell of
// image::meaningTable.

#include "image/grey_picture.h"

#include <OpenImageIO/imageio.h>
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <jpeglib.h>
#include <zlib.h>

#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "image/images.h"
#include "image/mask_picture.h"
#include "relief/height_field.h"
#include "render/gl_context.h"
#include "render/passes/method_texture.h"
#include "support/temporary_folder.h"
#include "support/tiff_files.h"

namespace gnomon::render {
namespace {

using image::Decision;
using image::Meaning;
using image::PictureUse;
using ::testing::HasSubstr;
using namespace std::string_literals;
using Values = std::vector<float>;

constexpr int width = 3;
constexpr int height = 2;
/// What a picture holds, rows from the top.
const Values plain = {1, 0, 1, 0, 0, 1};
/// No sample, in a mask.
constexpr float none = -1;

/// A file that says something, and what it must be read as where it is not refused.
struct SayingFile {
  Meaning meaning;
  std::string name;
  Values heights = plain;
  Values mask = plain;
  Values texture = plain;    ///< first channel
  std::string refusal = {};  ///< words of it, where there is one
};

std::vector<double> numbersOf(const Values& values, double scale = 1) {
  std::vector<double> numbers;
  for (const float value : values) numbers.push_back(static_cast<double>(value) * scale);
  return numbers;
}

/// Each value beside others.
std::vector<double> beside(const Values& values, const std::vector<double>& others,
                           double scale = 1) {
  std::vector<double> numbers;
  for (const float value : values) {
    numbers.push_back(static_cast<double>(value) * scale);
    numbers.insert(numbers.end(), others.begin(), others.end());
  }
  return numbers;
}

Values replacedAt(Values values, std::size_t at, float by) {
  values.at(at) = by;
  return values;
}

class SayingFiles : public TemporaryFolder {
 protected:
  void tiff(const std::string& name, test::TestTiff description,
            const std::vector<double>& numbers) const {
    description.width = width;
    description.height = height;
    test::writeTiff(file(name), description, numbers);
  }
  /// One of 8 bits with a tag more.
  template <typename Set>
  void taggedTiff(const std::string& name, const Set& set) const {
    test::TestTiff description;
    description.tags = set;
    tiff(name, description, numbersOf(plain, 255));
  }

  static OIIO::ImageSpec spec(const std::vector<std::string>& channels, OIIO::TypeDesc type) {
    OIIO::ImageSpec spec(width, height, static_cast<int>(channels.size()), type);
    spec.channelnames = channels;
    spec.alpha_channel = spec.channelindex("A");
    return spec;
  }
  template <typename Number>
  void write(const std::string& name, const std::vector<OIIO::ImageSpec>& specs,
             const std::vector<std::vector<Number>>& numbers, OIIO::TypeDesc type) const {
    const std::string path = file(name).string();
    const auto out = OIIO::ImageOutput::create(path);
    ASSERT_TRUE(specs.size() == 1 ? out->open(path, specs[0])
                                  : out->open(path, static_cast<int>(specs.size()), specs.data()));
    for (std::size_t i = 0; i < specs.size(); ++i) {
      ASSERT_TRUE(i == 0 || out->open(path, specs[i], OIIO::ImageOutput::AppendSubimage));
      ASSERT_TRUE(out->write_image(type, numbers[i].data())) << out->geterror();
    }
    ASSERT_TRUE(out->close());
  }
  void exr(const std::string& name, const OIIO::ImageSpec& spec, const Values& values) const {
    write<float>(name, {spec}, {values}, OIIO::TypeFloat);
  }

  /// A PNG of 8-bit greys with chunks put behind its header, or its pixels.
  void png(const std::string& name, const std::vector<std::pair<std::string, std::string>>& chunks,
           bool isBehind = false) const {
    image::ByteImage picture{width, height, {}};
    for (const float value : plain) picture.values.push_back(value == 1 ? 255 : 0);
    std::string bytes = image::pngOf(picture);
    std::size_t at = isBehind ? bytes.size() - 12 : 33;
    for (const auto& [type, content] : chunks) {
      const std::string chunk = type + content;
      const auto sum = static_cast<std::uint32_t>(
          crc32(0, reinterpret_cast<const Bytef*>(chunk.data()), static_cast<uInt>(chunk.size())));
      const std::string whole = big(static_cast<std::uint32_t>(content.size())) + chunk + big(sum);
      bytes.insert(at, whole);
      at += whole.size();
    }
    writeTextAtomically(file(name), bytes);
  }
  static std::string big(std::uint32_t number) {
    std::string bytes;
    for (int i = 3; i >= 0; --i) bytes += static_cast<char>(number >> 8 * i);
    return bytes;
  }
  /// Exif of one entry: the orientation.
  static std::string exif(int orientation) {
    std::string bytes = "MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\0\0\0\0\0\0\0"s;
    bytes[19] = static_cast<char>(orientation);
    return bytes;
  }

  /// A JPEG of `plain`, in greys or as CMYK.
  void jpeg(const std::string& name, bool isCmyk, int orientation) const {
    std::FILE* const out = std::fopen(file(name).c_str(), "wb");
    jpeg_compress_struct state;
    jpeg_error_mgr errors;
    state.err = jpeg_std_error(&errors);
    jpeg_create_compress(&state);
    jpeg_stdio_dest(&state, out);
    // Blocks of eight pixels, each of one grey, have no losses.
    state.image_width = 8 * width;
    state.image_height = 8 * height;
    state.input_components = isCmyk ? 4 : 1;
    state.in_color_space = isCmyk ? JCS_CMYK : JCS_GRAYSCALE;
    jpeg_set_defaults(&state);
    jpeg_start_compress(&state, TRUE);
    const std::string marker = "Exif\0\0"s + exif(orientation);
    jpeg_write_marker(&state, JPEG_APP0 + 1, reinterpret_cast<const JOCTET*>(marker.data()),
                      static_cast<unsigned>(marker.size()));
    for (int y = 0; y < 8 * height; ++y) {
      std::vector<JSAMPLE> row;
      for (int x = 0; x < 8 * width; ++x) {
        const auto at = static_cast<std::size_t>(y / 8 * width + x / 8);
        row.insert(row.end(), isCmyk ? 4 : 1, plain[at] == 1 ? 255 : 0);
      }
      JSAMPROW rows = row.data();
      jpeg_write_scanlines(&state, &rows, 1);
    }
    jpeg_finish_compress(&state);
    jpeg_destroy_compress(&state);
    std::fclose(out);
  }

  /// A flat Radiance picture: one of exponent 1, values 1 and 0.
  void hdr(const std::string& name, const std::string& lines, const std::string& size) const {
    std::string bytes = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n" + lines + "\n" + size + "\n";
    for (const float value : plain) bytes += value == 1 ? "\x80\x80\x80\x81" : "\0\0\0\0"s;
    writeTextAtomically(file(name), bytes);
  }

  /// An uncompressed TGA, from the top: blue, green, red, alpha.
  void tga(const std::string& name, const std::string& pixels, int alphaType = -1) const {
    std::string bytes = "\0\0\x02\0\0\0\0\0\0\0\0\0\x03\0\x02\0\x20\x28"s + pixels;
    if (alphaType >= 0) {
      const auto extension = static_cast<std::uint32_t>(bytes.size());
      bytes += "\xef\x01"s + std::string(492, '\0') + static_cast<char>(alphaType);
      std::string place = big(extension);
      std::reverse(place.begin(), place.end());
      bytes += place + "\0\0\0\0"s + "TRUEVISION-XFILE.\0"s;
    }
    writeTextAtomically(file(name), bytes);
  }

  /// A BMP of 32 bits: blue, green, red, alpha.
  void bmp(const std::string& name, bool isDownward, const std::string& pixels) const {
    const std::string rows = isDownward ? "\xfe\xff\xff\xff"s : "\2\0\0\0"s;
    writeTextAtomically(file(name), "BM\x4e\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\3\0\0\0"s + rows +
                                        "\1\0\x20\0"s + std::string(24, '\0') + pixels);
  }

  std::vector<SayingFile> orientations() const {
    taggedTiff("turned.tif",
               [](TIFF* out) { TIFFSetField(out, TIFFTAG_ORIENTATION, ORIENTATION_RIGHTTOP); });
    png("turned.png", {{"eXIf", exif(8)}});
    png("turned-late.png", {{"eXIf", exif(8)}}, true);
    jpeg("turned.jpg", false, 3);
    hdr("turned.hdr", "", "+Y 2 +X 3");
    std::vector<SayingFile> files;
    for (const char* name :
         {"turned.tif", "turned.png", "turned-late.png", "turned.jpg", "turned.hdr"}) {
      files.push_back({Meaning::orientation, name, {}, {}, {}, "Orientation is"});
    }
    return files;
  }

  /// Of values that no turn leaves as they are.
  std::vector<SayingFile> rowOrders() const {
    const Values values = {1, 0, 0, 0, 1, 0};
    const auto grey = [&](bool isUpward, bool isLeftward, const std::string& white,
                          const std::string& black) {
      std::string bytes;
      for (int i = 0; i < width * height; ++i) {
        const int y = isUpward ? height - 1 - i / width : i / width;
        const int x = isLeftward ? width - 1 - i % width : i % width;
        bytes += values[static_cast<std::size_t>(y * width + x)] == 1 ? white : black;
      }
      return bytes;
    };
    for (const auto& [name, origin] : {std::pair("low.tga", '\0'), {"right.tga", '\x30'}}) {
      const bool isUpward = origin == '\0';
      writeTextAtomically(file(name), "\0\0\x03\0\0\0\0\0\0\0\0\0\x03\0\x02\0\x08"s + origin +
                                          grey(isUpward, !isUpward, "\xff", "\0"s));
    }
    writeTextAtomically(file("low.pfm"),
                        "Pf\n3 2\n1\n" + grey(true, false, "\x3f\x80\0\0"s, "\0\0\0\0"s));
    for (const auto& [name, isDownward] : {std::pair("low.bmp", false), {"top.bmp", true}}) {
      bmp(name, isDownward, grey(!isDownward, false, "\xff\xff\xff\xff", "\0\0\0\xff"s));
    }
    std::vector<SayingFile> files;
    for (const char* name : {"low.tga", "right.tga", "low.pfm", "low.bmp", "top.bmp"}) {
      files.push_back({Meaning::rowOrder, name, values, values, values});
    }
    std::string halves = "Pf\n3 2\n-2\n";
    for (const std::size_t i : {3U, 4U, 5U, 0U, 1U, 2U}) {
      halves += plain[i] == 1 ? "\0\0\0\x3f"s : "\0\0\0\0"s;
    }
    writeTextAtomically(file("scale.pfm"), halves);
    files.push_back({Meaning::scale, "scale.pfm"});
    return files;
  }

  std::vector<SayingFile> colourModels() const {
    const auto model = [&](const std::string& name, int photometric, int samples) {
      test::TestTiff description;
      description.photometric = photometric;
      description.samples = samples;
      tiff(name, description,
           beside(plain, std::vector<double>(static_cast<std::size_t>(samples - 1), 0), 255));
    };
    model("cmyk.tif", PHOTOMETRIC_SEPARATED, 4);
    model("lab.tif", PHOTOMETRIC_CIELAB, 3);
    model("ycbcr.tif", PHOTOMETRIC_YCBCR, 3);
    model("sensor.tif", PHOTOMETRIC_CFA, 1);
    jpeg("cmyk.jpg", true, 1);
    return {{Meaning::colourModel, "cmyk.tif", {}, {}, {}, "CMYK"},
            {Meaning::colourModel, "lab.tif", {}, {}, {}, "CIELAB"},
            {Meaning::colourModel, "ycbcr.tif", {}, {}, {}, "YCbCr"},
            {Meaning::colourModel, "sensor.tif", {}, {}, {}, "PhotometricInterpretation 32803"},
            {Meaning::colourModel, "cmyk.jpg", {}, {}, {}, "CMYK"}};
  }

  std::vector<SayingFile> whites() const {
    std::vector<SayingFile> files;
    const auto add = [&](int bits, int format, int coding) {
      test::TestTiff description;
      description.bits = bits;
      description.format = format;
      description.photometric = PHOTOMETRIC_MINISWHITE;
      description.compression = coding;
      const bool isTurned = format == SAMPLEFORMAT_UINT && bits <= 16;
      const double largest = isTurned ? std::exp2(bits) - 1 : 1;
      std::vector<double> numbers = numbersOf(plain, largest);
      for (double& number : numbers) number = largest - number;
      const std::string name = fmt::format("white{}.{}.{}.tif", bits, format, coding);
      tiff(name, description, numbers);
      const Meaning meaning = isTurned ? Meaning::whiteZeroInteger : Meaning::whiteZeroOther;
      files.push_back({meaning, name, plain, plain, plain, "white is 0"});
    };
    for (const int bits : {1, 2, 4, 8, 12, 16}) add(bits, SAMPLEFORMAT_UINT, COMPRESSION_NONE);
    add(1, SAMPLEFORMAT_UINT, COMPRESSION_CCITTFAX4);
    add(16, SAMPLEFORMAT_UINT, COMPRESSION_LZW);
    add(32, SAMPLEFORMAT_UINT, COMPRESSION_NONE);
    for (const int bits : {8, 16, 32}) add(bits, SAMPLEFORMAT_INT, COMPRESSION_NONE);
    for (const int bits : {16, 32, 64}) add(bits, SAMPLEFORMAT_IEEEFP, COMPRESSION_NONE);
    // Alpha beside it is not turned round.
    test::TestTiff covered;
    covered.samples = 2;
    covered.photometric = PHOTOMETRIC_MINISWHITE;
    covered.tags = [](TIFF* out) {
      const std::uint16_t kind = EXTRASAMPLE_UNASSALPHA;
      TIFFSetField(out, TIFFTAG_EXTRASAMPLES, 1, &kind);
    };
    Values black = plain;
    for (float& value : black) value = 1 - value;
    tiff("white.alpha.tif", covered, beside(black, {255}, 255));
    files.push_back({Meaning::whiteZeroInteger, "white.alpha.tif"});
    return files;
  }

  std::vector<SayingFile> palettes() const {
    test::TestTiff description;
    description.photometric = PHOTOMETRIC_PALETTE;
    description.tags = [](TIFF* out) {
      std::array<std::uint16_t, 256> colours{};
      colours[7] = 65535;
      TIFFSetField(out, TIFFTAG_COLORMAP, colours.data(), colours.data(), colours.data());
    };
    tiff("palette.tif", description, numbersOf(plain, 7));
    description.tags = [](TIFF* out) {
      std::array<std::uint16_t, 256> colours{};
      colours[7] = 255;  // as old writers have it
      TIFFSetField(out, TIFFTAG_COLORMAP, colours.data(), colours.data(), colours.data());
    };
    tiff("old-palette.tif", description, numbersOf(plain, 7));
    image::PaletteImage picture{width, height, {{255, 255, 255}, {0, 0, 0}}, {}};
    for (const float value : plain) picture.values.push_back(value == 1 ? 0 : 1);
    image::writePng(file("palette.png"), picture);
    // From the lowest row, filled up to four bytes; colours as blue, green, red and a filler.
    const std::string header = "BM"s + "\x46\0\0\0\0\0\0\0\x3e\0\0\0"s;
    const std::string info =
        "\x28\0\0\0\x03\0\0\0\x02\0\0\0\x01\0\x08\0\0\0\0\0\x08\0\0\0\0\0\0\0\0\0\0\0"
        "\x02\0\0\0\0\0\0\0"s;
    writeTextAtomically(file("palette.bmp"),
                        header + info + "\0\0\0\0\xff\xff\xff\0"s + "\0\0\x01\0\x01\0\x01\0"s);
    return {{Meaning::palette, "palette.tif"},
            {Meaning::palette, "old-palette.tif"},
            {Meaning::palette, "palette.png"},
            {Meaning::palette, "palette.bmp"}};
  }

  std::vector<SayingFile> numberTypes() const {
    std::vector<SayingFile> files;
    const auto add = [&](Meaning meaning, int bits, int format, double largest) {
      test::TestTiff description;
      description.bits = bits;
      description.format = format;
      const std::string name = fmt::format("type{}.{}.tif", bits, format);
      tiff(name, description, numbersOf(plain, largest));
      files.push_back({meaning, name, plain, plain, plain, fmt::format("{}-bit", bits)});
    };
    add(Meaning::fewBits, 1, SAMPLEFORMAT_UINT, 1);
    taggedTiff("reversed.tif",
               [](TIFF* out) { TIFFSetField(out, TIFFTAG_FILLORDER, FILLORDER_LSB2MSB); });
    files.push_back({Meaning::fewBits, "reversed.tif"});
    add(Meaning::fewBits, 4, SAMPLEFORMAT_UINT, 15);
    add(Meaning::fewBits, 12, SAMPLEFORMAT_UINT, 4095);
    add(Meaning::fewBits, 8, SAMPLEFORMAT_INT, 127);
    add(Meaning::fewBits, 16, SAMPLEFORMAT_INT, 32767);
    add(Meaning::wideIntegers, 32, SAMPLEFORMAT_UINT, 1);
    add(Meaning::wideIntegers, 32, SAMPLEFORMAT_INT, 1);
    add(Meaning::wideFloats, 64, SAMPLEFORMAT_IEEEFP, 1);
    add(Meaning::otherNumbers, 24, SAMPLEFORMAT_UINT, 16777215);
    add(Meaning::otherNumbers, 64, SAMPLEFORMAT_UINT, 1);
    add(Meaning::otherNumbers, 64, SAMPLEFORMAT_COMPLEXIEEEFP, 1);
    writeTextAtomically(file("few.pgm"), "P2\n3 2\n100\n100 0 100\n0 0 100\n");
    files.push_back({Meaning::fewBits, "few.pgm"});
    write<std::uint32_t>("counts.exr", {spec({"Y"}, OIIO::TypeUInt)}, {{1, 0, 1, 0, 0, 1}},
                         OIIO::TypeUInt);
    files.push_back({Meaning::wideIntegers, "counts.exr"});
    return files;
  }

  std::vector<SayingFile> colourSpaces() const {
    png("gamma.png", {{"gAMA", big(45455)}, {"sRGB", "\0"s}});
    hdr("exposure.hdr", "EXPOSURE=2.0\nGAMMA=2.2\n", "-Y 2 +X 3");
    taggedTiff("curve.tif", [](TIFF* out) {
      TIFFSetField(out, TIFFTAG_MAXSAMPLEVALUE, 100);
      TIFFSetField(out, TIFFTAG_MINSAMPLEVALUE, 10);
      test::setGdalText(out, 42112, "<GDALMetadata><Item name=\"SCALE\">2</Item></GDALMetadata>");
    });
    OIIO::ImageSpec linear = spec({"Y"}, OIIO::TypeFloat);
    linear.attribute("whiteLuminance", 100.0F);
    exr("white.exr", linear, plain);
    return {{Meaning::colourSpace, "gamma.png"},
            {Meaning::colourSpace, "exposure.hdr"},
            {Meaning::colourSpace, "curve.tif"},
            {Meaning::colourSpace, "white.exr"}};
  }

  /// `plain` is columns 1 to 3 of 5, and rows 1 and 2 of 4, of what the larger file holds; or the
  /// place of the smaller one.
  std::vector<SayingFile> windows() const {
    Values large(20, 0.5F);
    for (std::size_t i = 0; i < plain.size(); ++i) large[(i / 3 + 1) * 5 + i % 3 + 1] = plain[i];
    OIIO::ImageSpec over = spec({"Y"}, OIIO::TypeFloat);
    over.width = 5;
    over.height = 4;
    over.x = over.y = -1;
    exr("over.exr", over, large);
    OIIO::ImageSpec part = spec({"Y"}, OIIO::TypeFloat);
    part.full_width = part.full_height = 4;
    part.x = 1;
    part.y = 2;
    exr("part.exr", part, plain);
    exr("part.tif", part, plain);
    const Values placed = {none, none, none, none, none, none, none, none,
                           none, 1,    0,    1,    none, 0,    0,    1};
    return {{Meaning::largerWindow, "over.exr"},
            {Meaning::smallerWindow, "part.exr", {}, placed, {}, "no pixel at column 0, row 0"},
            {Meaning::smallerWindow, "part.tif", {}, placed, {}, "no pixel at column 0, row 0"}};
  }

  std::vector<SayingFile> noData() const {
    std::vector<SayingFile> files;
    const auto add = [&](int bits, int format, const char* text, double stored,
                         const std::string& said, double scale = 1) {
      test::TestTiff description;
      description.bits = bits;
      description.format = format;
      if (text != nullptr) {
        description.tags = [text](TIFF* out) { test::setGdalText(out, 42113, text); };
      }
      std::vector<double> numbers = numbersOf(plain, scale);
      numbers[4] = stored;
      const std::string name = fmt::format("nodata{}.tif", files.size());
      tiff(name, description, numbers);
      files.push_back({Meaning::noData,
                       name,
                       {},
                       replacedAt(plain, 4, none),
                       {},
                       "pixel (1, 1) holds " + said});
    };
    add(32, SAMPLEFORMAT_IEEEFP, "-9999", -9999, "-9999, which is no data");
    add(32, SAMPLEFORMAT_IEEEFP, "-3.4028234663852886e+38", -3.4028234663852886e+38, "-3.40");
    add(64, SAMPLEFORMAT_IEEEFP, "-1.7976931348623157e+308", -1.7976931348623157e+308, "-1.79");
    add(32, SAMPLEFORMAT_IEEEFP, "nan", NAN, "nan, which is no data");
    add(32, SAMPLEFORMAT_INT, "-32768", -32768, "-32768, which");
    add(16, SAMPLEFORMAT_INT, "-32767 ", -32767, "-32767, which", 32767);
    add(16, SAMPLEFORMAT_INT, nullptr, -32768, "-32768, which is no data", 32767);
    add(16, SAMPLEFORMAT_UINT, "65534", 65534, "65534, which", 65535);
    add(8, SAMPLEFORMAT_UINT, "77", 77, "77, which", 255);
    return files;
  }

  std::vector<SayingFile> alphas() const {
    std::vector<SayingFile> files;
    // Half of one, multiplied or not; the mask needs a threshold, by which its cover is a sample.
    const Values half = {0.5F, 0.5F};
    Values pixels;
    for (const float value : plain) pixels.insert(pixels.end(), {value * 0.5F, 0.5F});
    Values multiplied = plain;
    for (float& value : multiplied) value *= 0.5F;
    exr("multiplied.exr", spec({"Y", "A"}, OIIO::TypeFloat), pixels);
    files.push_back({Meaning::multipliedAlpha, "multiplied.exr", plain, plain, multiplied});
    const auto withAlpha = [&](const std::string& name, std::uint16_t kind, const Values& values) {
      test::TestTiff description;
      description.bits = 32;
      description.format = SAMPLEFORMAT_IEEEFP;
      description.samples = 2;
      description.tags = [kind](TIFF* out) { TIFFSetField(out, TIFFTAG_EXTRASAMPLES, 1, &kind); };
      tiff(name, description, std::vector<double>(values.begin(), values.end()));
    };
    withAlpha("multiplied.tif", EXTRASAMPLE_ASSOCALPHA, pixels);
    files.push_back({Meaning::multipliedAlpha, "multiplied.tif", plain, plain, multiplied});
    // Alpha 0 in the last pixel, whose value is 1.
    const Values uncovered = replacedAt(plain, 5, none);
    Values beside0;
    for (std::size_t i = 0; i < 6; ++i)
      beside0.insert(beside0.end(), {plain[i], i == 5 ? 0.F : 1.F});
    withAlpha("plain.tif", EXTRASAMPLE_UNASSALPHA, beside0);
    files.push_back({Meaning::alpha, "plain.tif", plain, uncovered, plain});
    exr("uncovered.exr", spec({"Y", "A"}, OIIO::TypeFloat), beside0);
    files.push_back({Meaning::alpha, "uncovered.exr", plain, uncovered, plain});
    OIIO::ImageSpec greyAlpha = spec({"Y", "A"}, OIIO::TypeUInt8);
    greyAlpha.attribute("oiio:UnassociatedAlpha", 1);
    exr("uncovered.png", greyAlpha, beside0);
    files.push_back({Meaning::alpha, "uncovered.png", plain, uncovered, plain});
    std::string bytes, halfBytes;
    for (std::size_t i = 0; i < 6; ++i) {
      const std::string grey(3, plain[i] == 1 ? '\xff' : '\0');
      bytes += grey + (i == 5 ? '\0' : '\xff');
      halfBytes += (plain[i] == 1 ? std::string(3, '\x80') : std::string(3, '\0')) + '\x80';
    }
    bmp("uncovered.bmp", true, bytes);
    files.push_back({Meaning::alpha, "uncovered.bmp", plain, uncovered, plain});
    png("transparent.png", {{"tRNS", "\0\xff"s}});
    Values transparent = plain;
    for (float& value : transparent) value = value == 1 ? none : value;
    files.push_back({Meaning::alpha, "transparent.png", plain, transparent, plain});
    tga("uncovered.tga", bytes);
    files.push_back({Meaning::alpha, "uncovered.tga", plain, uncovered, plain});
    // What stands beside colours that are not multiplied by it does not change them.
    tga("beside.tga", halfBytes);
    bmp("beside.bmp", true, halfBytes);
    tga("multiplied.tga", halfBytes, 4);
    Values stored = plain;
    for (float& value : stored) value *= 128.0F / 255;
    files.push_back({Meaning::multipliedAlpha, "multiplied.tga", plain, plain, stored});
    files.push_back({Meaning::alpha, "beside.tga", stored, plain, stored});
    files.push_back({Meaning::alpha, "beside.bmp", stored, plain, stored});
    return files;
  }

  std::vector<SayingFile> others() const {
    std::vector<SayingFile> files;
    Values colours;
    for (const float value : plain) colours.insert(colours.end(), {value, value, 1});
    exr("colours.exr", spec({"R", "G", "B"}, OIIO::TypeFloat), colours);
    exr("colours.png", spec({"R", "G", "B"}, OIIO::TypeUInt8), colours);
    exr("colours.tif", spec({"R", "G", "B"}, OIIO::TypeUInt16), colours);
    for (const char* name : {"colours.exr", "colours.png", "colours.tif"}) {
      files.push_back({Meaning::differentChannels,
                       name,
                       {},
                       {},
                       plain,
                       "its channels differ, 0 and 1 at column 1, row 0"});
    }
    Values other(6, 0.25F);
    write<float>("parts.exr", {spec({"Y"}, OIIO::TypeFloat), spec({"Z2"}, OIIO::TypeFloat)},
                 {plain, other}, OIIO::TypeFloat);
    files.push_back({Meaning::parts, "parts.exr"});
    TIFF* const pages = TIFFOpen(file("pages.tif").c_str(), "w");
    test::addTiff(pages, {width, height}, numbersOf(plain, 255));
    test::addTiff(pages, {width, height}, numbersOf(other, 255));
    TIFFClose(pages);
    files.push_back({Meaning::parts, "pages.tif"});
    const auto twoPages = [&](const std::string& name, int first, int second) {
      TIFF* const out = TIFFOpen(file(name).c_str(), "w");
      for (const int kind : {first, second}) {
        test::TestTiff page{width, height};
        page.tags = [kind](TIFF* tags) { TIFFSetField(tags, TIFFTAG_SUBFILETYPE, kind); };
        test::addTiff(out, page, numbersOf(plain, 255));
      }
      TIFFClose(out);
    };
    twoPages("pyramid.tif", 0, FILETYPE_REDUCEDIMAGE);
    files.push_back({Meaning::parts, "pyramid.tif"});
    twoPages("thumbnail.tif", FILETYPE_REDUCEDIMAGE, 0);
    files.push_back({Meaning::otherPage, "thumbnail.tif", {}, {}, {}, "a reduced copy"});
    twoPages("masked.tif", 0, FILETYPE_MASK);
    files.push_back({Meaning::otherPage, "masked.tif", {}, {}, {}, "page 2 says which pixels"});
    taggedTiff("page.tif", [](TIFF* out) {
      TIFFSetField(out, TIFFTAG_XPOSITION, 2.0);
      TIFFSetField(out, TIFFTAG_YPOSITION, 1.0);
      TIFFSetField(out, TIFFTAG_XRESOLUTION, 300.0);
      TIFFSetField(out, TIFFTAG_YRESOLUTION, 150.0);
    });
    png("page.png", {{"pHYs", big(100) + big(200) + "\x01"}, {"oFFs", big(5) + big(6) + "\0"s}});
    OIIO::ImageSpec wide = spec({"Y"}, OIIO::TypeFloat);
    wide.attribute("PixelAspectRatio", 2.0F);
    exr("wide.exr", wide, plain);
    for (const char* name : {"page.tif", "page.png", "wide.exr"}) {
      files.push_back({Meaning::density, name});
    }
    return files;
  }

  std::vector<SayingFile> all() const {
    std::vector<SayingFile> files;
    for (const auto& some :
         {orientations(), rowOrders(), colourModels(), whites(), palettes(), numberTypes(),
          colourSpaces(), windows(), noData(), alphas(), others()}) {
      files.insert(files.end(), some.begin(), some.end());
    }
    return files;
  }

  [[nodiscard]] Values heights(const std::string& name) const {
    const relief::HeightField field =
        relief::readHeightImage(file(name), {}, 1, relief::Wrap::clamp);
    Values values;
    for (int y = field.height() - 1; y >= 0; --y) {
      for (int x = 0; x < field.width(); ++x) values.push_back(field.texel(x, y));
    }
    return values;
  }
  [[nodiscard]] Values mask(const std::string& name) const {
    Values values;
    for (const Shade shade : image::readMaskPicture(file(name), {{}, 0.5}).mask.samples) {
      values.push_back(shade == Shade::none ? none : shade == Shade::lit ? 1.0F : 0.0F);
    }
    return values;
  }
  /// Red, rows from the top.
  [[nodiscard]] Values texture(const std::string& name) const {
    const GpuTexture texture({"own", file(name)});
    glBindTexture(GL_TEXTURE_2D, texture.texture());
    GLint columns = 0;
    GLint rows = 0;
    glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_WIDTH, &columns);
    glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_HEIGHT, &rows);
    Values upward(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    glGetTexImage(GL_TEXTURE_2D, 0, GL_RED, GL_FLOAT, upward.data());
    Values values;
    for (int y = rows - 1; y >= 0; --y) {
      values.insert(values.end(), upward.begin() + y * columns, upward.begin() + (y + 1) * columns);
    }
    return values;
  }
};

/// A JPEG of these has larger pixels: one of each block.
Values thinned(const Values& values) {
  if (values.size() != 64 * plain.size()) return values;
  Values few;
  for (std::size_t i = 0; i < plain.size(); ++i) {
    few.push_back(values[(i / width * 8 + 4) * 8 * width + i % width * 8 + 4]);
  }
  return few;
}

TEST_F(SayingFiles, AreReadOrRefusedAsTheTableHasItForEveryUse) {
  const GlContext gl;
  std::set<std::pair<Meaning, PictureUse>> cells;
  for (const SayingFile& saying : all()) {
    const auto check = [&](PictureUse use, const Values& expected, const auto& read) {
      SCOPED_TRACE(fmt::format("{}, use {}", saying.name, static_cast<int>(use)));
      cells.insert({saying.meaning, use});
      const auto& row = image::meaningTable().at(static_cast<std::size_t>(saying.meaning));
      const bool isRefused =
          row.uses.at(static_cast<std::size_t>(use)).decision == Decision::refused;
      try {
        const Values found = thinned(read(saying.name));
        EXPECT_FALSE(isRefused);
        EXPECT_THAT(found, ::testing::Pointwise(::testing::FloatNear(1e-6F), expected));
      } catch (const InputError& error) {
        EXPECT_TRUE(isRefused) << error.what();
        EXPECT_THAT(error.what(), HasSubstr(saying.name + ": "));
        EXPECT_THAT(error.what(), HasSubstr(saying.refusal));
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      }
    };
    check(PictureUse::heights, saying.heights, [&](const auto& name) { return heights(name); });
    check(PictureUse::mask, saying.mask, [&](const auto& name) { return mask(name); });
    check(PictureUse::method, saying.texture, [&](const auto& name) { return texture(name); });
  }
  EXPECT_EQ(cells.size(), 3 * image::meaningTable().size()) << "a cell without a file";
}

// One channel named has no others to agree with.
TEST_F(SayingFiles, OfDifferentChannelsAreHeightsByANumber) {
  (void)others();
  for (const char* name : {"colours.exr", "colours.png", "colours.tif"}) {
    const relief::HeightField field =
        relief::readHeightImage(file(name), 2, 1, relief::Wrap::clamp);
    EXPECT_EQ(field.minimum(), 1) << name;
    EXPECT_EQ(field.maximum(), 1) << name;
  }
}

TEST(MeaningTable, StandsInTheManual) {
  const std::string page =
      readFile(std::filesystem::path(GNOMON_SCENES).parent_path() / "docs/writing-a-study.md");
  const std::string table = image::meaningTableText();
  EXPECT_NE(page.find(table), std::string::npos) << "expected there:\n" << table;
}

}  // namespace
}  // namespace gnomon::render
