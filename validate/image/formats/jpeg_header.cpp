#include "image/formats/jpeg_header.h"

#include <fstream>

namespace gnomon::image {
namespace {

constexpr int endOfFile = std::char_traits<char>::eof();

/// The next marker, past bytes that belong to none, as libjpeg looks for it; or the file's end.
int nextMarker(std::ifstream& file) {
  int byte = file.get();
  while (byte != endOfFile) {
    while (byte != 0xff && byte != endOfFile) byte = file.get();
    while (byte == 0xff) byte = file.get();
    if (byte != 0) return byte;
  }
  return endOfFile;
}

int word(std::ifstream& file) {
  const int high = file.get();
  return high << 8 | file.get();
}

bool startsFrame(int marker) {
  return marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
}

/// Markers without a length: restarts, the start of the image, and TEM.
bool standsAlone(int marker) {
  return (marker >= 0xd0 && marker <= 0xd8) || marker == 0x01;
}

}  // namespace

std::optional<JpegFrame> jpegFrame(const std::filesystem::path& path) {
  constexpr int startOfScan = 0xda;
  constexpr int endOfImage = 0xd9;
  std::ifstream file(path, std::ios::binary);
  for (int marker = nextMarker(file); marker != endOfFile; marker = nextMarker(file)) {
    if (marker == startOfScan || marker == endOfImage) return std::nullopt;
    if (standsAlone(marker)) continue;
    const int length = word(file);
    if (startsFrame(marker)) {
      (void)file.get();  // bits of a number
      JpegFrame frame;
      frame.height = word(file);
      frame.width = word(file);
      frame.components = file.get();
      return file ? std::optional(frame) : std::nullopt;
    }
    file.seekg(length - 2, std::ios::cur);
  }
  return std::nullopt;
}

}  // namespace gnomon::image
