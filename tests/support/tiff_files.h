#pragma once

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <tiffio.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace gnomon::test {

/// A TIFF for a test to write by libtiff.
struct TestTiff {
  int width = 0;
  int height = 0;
  int bits = 8;
  int format = SAMPLEFORMAT_UINT;
  int samples = 1;
  int photometric = PHOTOMETRIC_MINISBLACK;
  int compression = COMPRESSION_NONE;
  int predictor = PREDICTOR_NONE;
  bool isTiled = false;
  bool isSeparate = false;
  bool isBigEndian = false;
  bool isBig = false;                    ///< BigTIFF
  std::function<void(TIFF*)> tags = {};  ///< sets more of them
};

/// Appends a number as the processor has it; integers of other than 8, 16, 32 or 64 bits are
/// packed.
class TiffBytes {
 public:
  TiffBytes(int bits, int format) : bits_(bits), format_(format) {}

  void add(double number) {
    if (format_ == SAMPLEFORMAT_IEEEFP) {
      const auto single = static_cast<float>(number);
      if (bits_ == 64) return addBytes(number);
      if (bits_ == 32) return addBytes(single);
      std::uint16_t half = 0;
      EXPECT_TRUE(OIIO::convert_pixel_values(OIIO::TypeFloat, &single, OIIO::TypeHalf, &half));
      return addBytes(half);
    }
    const auto code = static_cast<std::int64_t>(number);
    switch (bits_) {
      case 8:
        return addBytes(static_cast<std::uint8_t>(code));
      case 16:
        return addBytes(static_cast<std::uint16_t>(code));
      case 32:
        return addBytes(static_cast<std::uint32_t>(code));
      case 64:
        return addBytes(code);
      default:
        for (int bit = bits_ - 1; bit >= 0; --bit) addBit((code >> bit & 1) != 0);
    }
  }
  void endRow() { bit_ = 0; }
  std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  template <typename Number>
  void addBytes(Number number) {
    std::array<std::uint8_t, sizeof number> bytes{};
    std::memcpy(bytes.data(), &number, sizeof number);
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  void addBit(bool isSet) {
    if (bit_ == 0) bytes_.push_back(0);
    if (isSet) bytes_.back() = static_cast<std::uint8_t>(bytes_.back() | 0x80 >> bit_);
    bit_ = (bit_ + 1) % 8;
  }

  int bits_, format_;
  int bit_ = 0;
  std::vector<std::uint8_t> bytes_;
};

/// Sets a tag of GDAL's: 42112 for what it says of scales, 42113 for "no data".
inline void setGdalText(TIFF* file, std::uint32_t tag, const char* text) {
  static const std::array<TIFFFieldInfo, 2> infos = {
      {{42112, -1, -1, TIFF_ASCII, FIELD_CUSTOM, 1, 0, const_cast<char*>("GDALMetadata")},
       {42113, -1, -1, TIFF_ASCII, FIELD_CUSTOM, 1, 0, const_cast<char*>("GDALNoData")}}};
  TIFFMergeFieldInfo(file, infos.data(), infos.size());
  EXPECT_EQ(TIFFSetField(file, tag, text), 1);
}

/// Appends a picture to an open file.
/// @param numbers  as the file holds them: those of a pixel beside each other, rows from the top
inline void addTiff(TIFF* file, const TestTiff& tiff, const std::vector<double>& numbers) {
  constexpr int tile = 16;
  constexpr int stripRows = 5;
  const auto set = [&](std::uint32_t tag, auto value) {
    ASSERT_EQ(TIFFSetField(file, tag, value), 1) << tag;
  };
  set(TIFFTAG_IMAGEWIDTH, tiff.width);
  set(TIFFTAG_IMAGELENGTH, tiff.height);
  set(TIFFTAG_BITSPERSAMPLE, tiff.bits);
  set(TIFFTAG_SAMPLEFORMAT, tiff.format);
  set(TIFFTAG_SAMPLESPERPIXEL, tiff.samples);
  set(TIFFTAG_PHOTOMETRIC, tiff.photometric);
  set(TIFFTAG_COMPRESSION, tiff.compression);
  set(TIFFTAG_PLANARCONFIG, tiff.isSeparate ? PLANARCONFIG_SEPARATE : PLANARCONFIG_CONTIG);
  if (tiff.predictor != PREDICTOR_NONE) set(TIFFTAG_PREDICTOR, tiff.predictor);
  if (tiff.isTiled) {
    set(TIFFTAG_TILEWIDTH, tile);
    set(TIFFTAG_TILELENGTH, tile);
  } else {
    set(TIFFTAG_ROWSPERSTRIP, stripRows);
  }
  if (tiff.tags) tiff.tags(file);
  const int planes = tiff.isSeparate ? tiff.samples : 1;
  const int width = tiff.isTiled ? tile : tiff.width;
  const int rows = tiff.isTiled ? tile : stripRows;
  std::uint32_t piece = 0;
  for (int plane = 0; plane < planes; ++plane) {
    for (int top = 0; top < tiff.height; top += rows) {
      for (int left = 0; left < tiff.width; left += width) {
        TiffBytes bytes(tiff.bits, tiff.format);
        const int bottom = tiff.isTiled ? top + rows : std::min(top + rows, tiff.height);
        for (int y = top; y < bottom; ++y) {
          for (int x = left; x < left + width; ++x) {
            for (int s = plane; s < (tiff.isSeparate ? plane + 1 : tiff.samples); ++s) {
              const bool isInside = x < tiff.width && y < tiff.height;
              const int at = (y * tiff.width + x) * tiff.samples + s;
              bytes.add(isInside ? numbers.at(static_cast<std::size_t>(at)) : 0);
            }
          }
          bytes.endRow();
        }
        std::vector<std::uint8_t> packed = bytes.take();
        const auto size = static_cast<tmsize_t>(packed.size());
        // libtiff turns bytes round before this predictor, which has the same order in all files.
        if (tiff.predictor == PREDICTOR_FLOATINGPOINT && tiff.isBigEndian) {
          for (auto at = packed.begin(); at != packed.end(); at += tiff.bits / 8) {
            std::reverse(at, at + tiff.bits / 8);
          }
        }
        const tmsize_t written = tiff.isTiled
                                     ? TIFFWriteEncodedTile(file, piece, packed.data(), size)
                                     : TIFFWriteEncodedStrip(file, piece, packed.data(), size);
        ++piece;
        ASSERT_EQ(written, size);
      }
    }
  }
  ASSERT_EQ(TIFFWriteDirectory(file), 1);
}

inline void writeTiff(const std::filesystem::path& path, const TestTiff& tiff,
                      const std::vector<double>& numbers) {
  const std::string mode = std::string(tiff.isBigEndian ? "wb" : "wl") + (tiff.isBig ? "8" : "");
  TIFF* const file = TIFFOpen(path.c_str(), mode.c_str());
  ASSERT_NE(file, nullptr);
  addTiff(file, tiff, numbers);
  TIFFClose(file);
}

}  // namespace gnomon::test
