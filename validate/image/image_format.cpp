#include "image/image_format.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>

namespace gnomon::image {
namespace {

using namespace std::string_view_literals;

/// Bytes at a place in a file, and what has them there.
template <typename Kind>
struct Signature {
  std::string_view bytes;
  Kind kind;
  std::size_t at = 0;
};

template <typename Kind>
bool isAt(std::string_view start, const Signature<Kind>& signature) {
  return start.size() >= signature.at + signature.bytes.size() &&
         start.compare(signature.at, signature.bytes.size(), signature.bytes) == 0;
}

constexpr std::array signatures = {
    Signature<ImageFormat>{"\x76\x2f\x31\x01"sv, ImageFormat::exr},
    Signature<ImageFormat>{"\x89PNG\r\n\x1a\n"sv, ImageFormat::png},
    Signature<ImageFormat>{"II*\0"sv, ImageFormat::tiff},
    Signature<ImageFormat>{"MM\0*"sv, ImageFormat::tiff},
    Signature<ImageFormat>{"II+\0"sv, ImageFormat::tiff},  // BigTIFF
    Signature<ImageFormat>{"MM\0+"sv, ImageFormat::tiff},
    Signature<ImageFormat>{"\xff\xd8\xff"sv, ImageFormat::jpeg},
    Signature<ImageFormat>{"#?RADIANCE"sv, ImageFormat::hdr},
    Signature<ImageFormat>{"#?RGBE"sv, ImageFormat::hdr},
    Signature<ImageFormat>{"BM"sv, ImageFormat::bmp},
};

/// What readers know that are never asked, and what else often stands where a picture is expected.
constexpr std::array others = {
    Signature<const char*>{"GIF8"sv, "a GIF picture"},
    Signature<const char*>{"\x53\x80\xf6\x34"sv, "a Softimage picture"},
    Signature<const char*>{"FOR4"sv, "an IFF picture"},
    Signature<const char*>{"FOR8"sv, "an IFF picture"},
    Signature<const char*>{"FORM"sv, "an IFF file"},
    Signature<const char*>{"\x01\xda"sv, "an SGI picture"},
    Signature<const char*>{"8BPS"sv, "a Photoshop picture (PSD)"},
    Signature<const char*>{"SDPX"sv, "a DPX picture"},
    Signature<const char*>{"XPDS"sv, "a DPX picture"},
    Signature<const char*>{"\x80\x2a\x5f\xd7"sv, "a Cineon picture"},
    Signature<const char*>{"\xd7\x5f\x2a\x80"sv, "a Cineon picture"},
    Signature<const char*>{"SIMPLE  ="sv, "a FITS picture"},
    Signature<const char*>{"\xff\xfe"sv, "an RLA picture", 26},
    Signature<const char*>{"jP  "sv, "a JPEG 2000 picture", 4},
    Signature<const char*>{"\xff\x4f\xff\x51"sv, "a JPEG 2000 picture"},
    Signature<const char*>{"JXL "sv, "a JPEG XL picture", 4},
    Signature<const char*>{"\xff\x0a"sv, "a JPEG XL picture"},
    Signature<const char*>{"WEBP"sv, "a WebP picture", 8},
    Signature<const char*>{"ftyp"sv, "a HEIF picture, an AVIF picture or a film", 4},
    Signature<const char*>{"DDS "sv, "a DDS picture"},
    Signature<const char*>{"\xabKTX"sv, "a KTX picture"},
    Signature<const char*>{"qoif"sv, "a QOI picture"},
    Signature<const char*>{"farbfeld"sv, "a farbfeld picture"},
    Signature<const char*>{"P7\n"sv, "a PAM picture"},
    Signature<const char*>{"\0\0\1\0"sv, "an icon (ICO)"},
    Signature<const char*>{"\0\0\2\0\1\0\0\0"sv, "a cursor (CUR)"},
    Signature<const char*>{"\x2f\x08\x67\xab"sv, "a Zfile depth map"},
    Signature<const char*>{"\xab\x67\x08\x2f"sv, "a Zfile depth map"},
    Signature<const char*>{"Ptex"sv, "a Ptex texture"},
    Signature<const char*>{" BDV"sv, "an OpenVDB volume"},
    Signature<const char*>{"/* XPM"sv, "an XPM picture"},
    Signature<const char*>{"<svg"sv, "an SVG drawing"},
    Signature<const char*>{"<?xml"sv, "an XML file"},
    Signature<const char*>{"<!DOCTYPE"sv, "an HTML page"},
    Signature<const char*>{"<html"sv, "an HTML page"},
    Signature<const char*>{"version https://git-lfs"sv, "a pointer of Git LFS to a file elsewhere"},
    Signature<const char*>{"%PDF"sv, "a PDF file"},
    Signature<const char*>{"%!PS"sv, "a PostScript file"},
    Signature<const char*>{"PK\3\4"sv, "a ZIP archive"},
    Signature<const char*>{"\x1f\x8b"sv, "a file packed by gzip"},
    Signature<const char*>{"ply\n"sv, "a PLY mesh"},
    Signature<const char*>{"\x93NUMPY"sv, "a NumPy array"},
};

const char* otherKind(std::string_view start) {
  for (const auto& other : others) {
    if (isAt(start, other)) return other.kind;
  }
  return nullptr;
}

bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f';
}

/// "P5" and a blank or a comment; P1 to P6 are PNM, Pf and PF its floats.
std::optional<ImageFormat> netpbmFormat(std::string_view start) {
  if (start.size() < 3 || start[0] != 'P' || !(isBlank(start[2]) || start[2] == '#')) return {};
  if (start[1] >= '1' && start[1] <= '6') return ImageFormat::pnm;
  if (start[1] == 'f' || start[1] == 'F') return ImageFormat::pfm;
  return {};
}

enum class TgaKind { none, plain, mapped };

/// A header that is right in every field (Truevision TGA 2.0, pages 6 to 9): whether there is a
/// colour map, which kind of picture, the map's and the pixel's bits, both sides.
TgaKind tgaKind(std::string_view start) {
  constexpr std::size_t headerBytes = 18;
  if (start.size() < headerBytes) return TgaKind::none;
  const auto byte = [&](std::size_t at) { return static_cast<std::uint8_t>(start[at]); };
  const auto word = [&](std::size_t at) { return byte(at) | byte(at + 1) << 8; };
  const auto isAmong = [](int value, std::initializer_list<int> values) {
    return std::find(values.begin(), values.end(), value) != values.end();
  };
  const int kind = byte(2) & ~8;  // 8: packed
  const int mapBits = byte(7);
  const int pixelBits = byte(16);
  const bool isMapped = byte(1) == 1;
  const bool isRight = byte(1) <= 1 && byte(2) <= 11 && word(12) > 0 && word(14) > 0 &&
                       (!isMapped || isAmong(mapBits, {15, 16, 24, 32}));
  const bool isPixelRight =
      kind == 2 ? isAmong(pixelBits, {15, 16, 24, 32})
                : isAmong(kind, {1, 3}) && isAmong(pixelBits, {8, 16}) && (kind == 3 || isMapped);
  if (!isRight || !isPixelRight) return TgaKind::none;
  return isMapped ? TgaKind::mapped : TgaKind::plain;
}

}  // namespace

const char* nameOf(ImageFormat format) {
  constexpr std::array names = {"EXR", "PNG", "TIFF", "JPEG", "HDR", "PNM", "PFM", "BMP", "TGA"};
  return names.at(static_cast<std::size_t>(format));
}

std::optional<ImageFormat> imageFormatOf(std::string_view start) {
  for (const auto& signature : signatures) {
    if (isAt(start, signature)) return signature.kind;
  }
  if (const auto netpbm = netpbmFormat(start)) return netpbm;
  if (otherKind(start) == nullptr && tgaKind(start) == TgaKind::plain) return ImageFormat::tga;
  return std::nullopt;
}

std::string otherFileKind(std::string_view start) {
  if (start.empty()) return "an empty file";
  const char* kind = otherKind(start);
  // Its reader looks up colours that the map does not have.
  if (kind == nullptr && tgaKind(start) == TgaKind::mapped) return "a TGA with a colour map";
  return kind != nullptr ? kind : "a file of an unknown kind";
}

}  // namespace gnomon::image
