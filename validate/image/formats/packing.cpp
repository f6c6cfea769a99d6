#include "image/formats/packing.h"

#include <limits>

namespace gnomon::image {
namespace {

constexpr double unpacked = 2;
constexpr double runs = 256;
constexpr double packed = 3000;
constexpr double unbounded = std::numeric_limits<double>::infinity();

double mostInExr(const std::string& coding) {
  if (coding == "none") return unpacked;
  if (coding == "rle") return runs;
  // A block of DWA's may hold nothing but the fact that it is flat.
  return coding.starts_with("dwa") ? unbounded : packed;
}

double mostInTiff(const std::string& coding) {
  if (coding == "none") return unpacked;
  if (coding == "packbits") return runs;
  // A fax holds a whole white row in a bit.
  return coding == "zip" || coding == "lzw" || coding == "jpeg" ? packed : unbounded;
}

}  // namespace

double mostBytesAByteHolds(ImageFormat format, const std::string& coding) {
  switch (format) {
    case ImageFormat::exr:
      return mostInExr(coding);
    case ImageFormat::tiff:
      return mostInTiff(coding);
    case ImageFormat::png:
    case ImageFormat::jpeg:
      return packed;
    case ImageFormat::hdr:
    case ImageFormat::tga:
    case ImageFormat::bmp:
      return runs;
    case ImageFormat::pnm:
    case ImageFormat::pfm:
      // Eight pixels of a bitmap are a byte of the file, and eight of the reader.
      return 8 * unpacked;
  }
  return unbounded;
}

}  // namespace gnomon::image
