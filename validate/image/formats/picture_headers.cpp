#include "image/formats/picture_headers.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <fstream>
#include <set>
#include <string>

#include "image/image_module.h"

namespace gnomon::image {

void requireSoundBmpHeader(const std::filesystem::path& path) {
  constexpr std::uint32_t fileHeader = 14;
  constexpr std::uint32_t coreHeader = 12;
  constexpr std::uint32_t infoHeader = 40;
  constexpr std::uint32_t longestHeader = 124;
  std::array<std::uint8_t, 54> start{};
  std::ifstream file(path, std::ios::binary);
  file.read(reinterpret_cast<char*>(start.data()), start.size());
  const auto bytesRead = static_cast<std::size_t>(file.gcount());
  const auto number = [&](std::size_t at, std::size_t size) {
    std::uint32_t value = 0;
    for (std::size_t i = size; i-- > 0;) value = value << 8 | start.at(at + i);
    return value;
  };
  const std::uint32_t header = number(fileHeader, 4);
  const bool isCore = header == coreHeader;
  if (bytesRead < fileHeader + coreHeader || (!isCore && header < infoHeader) ||
      header > longestHeader) {
    throw ImageError("its header is no BMP's");
  }
  const std::uint32_t bits = isCore ? number(24, 2) : number(28, 2);
  const std::uint32_t stated = isCore ? 0 : number(46, 4);
  constexpr std::uint32_t mostColours = 256;
  if (stated > mostColours) throw ImageError("its palette has more than 256 colours");
  const std::uint32_t colours = bits > 8 ? 0 : stated > 0 ? stated : 1U << bits;
  const std::uint64_t end = fileHeader + header + colours * (isCore ? 3U : 4U);
  if (end > std::filesystem::file_size(path)) throw ImageError("it ends in its header");
}

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

namespace {

/// Numbers of a TIFF structure; 0 past its end.
class Numbers {
 public:
  explicit Numbers(std::span<const std::uint8_t> bytes)
      : bytes_(bytes), isBig_(!bytes.empty() && bytes[0] == 'M') {}

  [[nodiscard]] std::size_t two(std::size_t at) const { return number(at, 2); }
  [[nodiscard]] std::size_t four(std::size_t at) const { return number(at, 4); }

 private:
  [[nodiscard]] std::size_t number(std::size_t at, std::size_t count) const {
    if (at > bytes_.size() || bytes_.size() - at < count) return 0;
    std::size_t value = 0;
    for (std::size_t i = 0; i < count; ++i) {
      value = value << 8 | bytes_[isBig_ ? at + i : at + count - 1 - i];
    }
    return value;
  }

  std::span<const std::uint8_t> bytes_;
  bool isBig_;
};

}  // namespace

int exifOrientation(std::span<const std::uint8_t> exif) {
  constexpr std::size_t orientation = 274;
  constexpr std::size_t entryBytes = 12;
  const Numbers numbers(exif);
  const std::size_t directory = numbers.four(4);
  const std::size_t entries = numbers.two(directory);
  for (std::size_t i = 0; i < entries; ++i) {
    const std::size_t entry = directory + 2 + i * entryBytes;
    if (numbers.two(entry) != orientation) continue;
    const std::size_t value = numbers.two(entry + 8);
    return value >= 1 && value <= 8 ? static_cast<int>(value) : 1;
  }
  return 1;
}

namespace {

constexpr std::streamoff fileStart = 8;  // magic and version
constexpr std::uint8_t multipleParts = 0x10;
constexpr std::uint8_t tiled = 0x02;
constexpr std::uint64_t mostChunkRows = 256;  // DWAB's

class Header {
 public:
  explicit Header(const std::filesystem::path& path)
      : file_(path, std::ios::binary), bytes_(std::filesystem::file_size(path)) {
    std::array<char, fileStart> start{};
    file_.read(start.data(), start.size());
    hasParts_ = (static_cast<std::uint8_t>(start[5]) & multipleParts) != 0;
    isTiled_ = (static_cast<std::uint8_t>(start[5]) & tiled) != 0;
  }

  void check() {
    while (checkPart() && hasParts_) {
    }
  }

 private:
  /// @return whether there was one: a header without attributes ends the parts
  bool checkPart() {
    std::uint64_t columns = 1;
    std::uint64_t rows = 1;
    std::uint64_t tileColumns = 0;
    std::uint64_t tileRows = 0;
    std::uint64_t chunkRows = mostChunkRows;
    std::set<std::string> found;
    for (std::string name = text(); !name.empty(); name = text()) {
      const std::string type = text();
      const auto size = static_cast<std::uint32_t>(number());
      const std::streamoff value = file_.tellg();
      if (!file_ || size > bytes_ - static_cast<std::uint64_t>(value)) {
        throw ImageError("an attribute of its header is longer than the file");
      }
      found.insert(name + " " + type);
      if (type == "box2i" && name == "dataWindow") {
        const std::int64_t left = number();
        const std::int64_t top = number();
        columns = side(left, number());
        rows = side(top, number());
      } else if (type == "tiledesc" && name == "tiles") {
        tileColumns = static_cast<std::uint32_t>(number());
        tileRows = static_cast<std::uint32_t>(number());
      } else if (type == "compression" && name == "compression") {
        chunkRows = rowsOfChunks(file_.get());
      }
      file_.seekg(value + static_cast<std::streamoff>(size));
    }
    if (found.empty() && hasParts_) return false;
    requireAttributes(found, tileColumns > 0 && tileRows > 0);
    requireSides(columns, rows);
    requireTile(tileColumns, tileRows, columns * rows);
    if (tileColumns > 0) {
      requireIndex(parts(columns, tileColumns), parts(rows, tileRows));
    } else {
      requireChunks(parts(rows, chunkRows));
    }
    return true;
  }

  /// What a reader divides by and counts with. Tiles are announced in the version, or by each part.
  void requireAttributes(const std::set<std::string>& found, bool hasTiles) const {
    for (const char* needed :
         {"channels chlist", "compression compression", "dataWindow box2i", "displayWindow box2i",
          "lineOrder lineOrder", "pixelAspectRatio float", "screenWindowCenter v2f",
          "screenWindowWidth float"}) {
      if (!found.contains(needed)) {
        throw ImageError(std::string("its header lacks an attribute (name and type): ") + needed);
      }
    }
    const bool isContrary =
        hasParts_ ? found.contains("tiles tiledesc") && !hasTiles : isTiled_ != hasTiles;
    if (isContrary) throw ImageError("its header contradicts itself");
  }

  static void requireSides(std::uint64_t columns, std::uint64_t rows) {
    constexpr std::uint64_t longest = 1 << 20;
    if (columns > longest || rows > longest) throw ImageError("a side of it is over 2^20 pixels");
  }

  /// A tile may be larger than the picture, but not by much: the reader takes memory for all of it.
  static void requireTile(std::uint64_t columns, std::uint64_t rows, std::uint64_t pixels) {
    constexpr std::uint64_t usual = 4096 * 4096;
    if (columns * rows > std::max(usual, pixels)) {
      throw ImageError("a tile of it is far larger than the picture");
    }
  }

  /// Each tile has an entry of 8 bytes.
  void requireIndex(std::uint64_t columns, std::uint64_t rows) const {
    if (columns <= bytes_ / 8 / rows) return;
    throw ImageError("the index of its tiles is longer than the file");
  }

  /// Each chunk of rows has an entry of 8 bytes, and before its pixels its first row and its
  /// length.
  void requireChunks(std::uint64_t chunks) const {
    if (chunks <= bytes_ / 16) return;
    throw ImageError("its rows need a longer file, however they are packed");
  }

  /// Rows that a chunk holds at most, by the number of the compression.
  static std::uint64_t rowsOfChunks(int compression) {
    constexpr std::array<std::uint64_t, 10> rows = {1, 1, 1, 16, 32, 16, 32, 32, 32, mostChunkRows};
    const auto at = static_cast<std::size_t>(compression);
    return compression < 0 || at >= rows.size() ? mostChunkRows : rows[at];
  }

  static std::uint64_t side(std::int64_t first, std::int64_t last) {
    return last < first ? 1 : static_cast<std::uint64_t>(last - first) + 1;
  }
  static std::uint64_t parts(std::uint64_t whole, std::uint64_t part) {
    return part == 0 ? 1 : (whole + part - 1) / part;
  }

  /// Up to a zero; names are at most 255 characters long.
  std::string text() {
    constexpr std::size_t longest = 255;
    std::string found;
    for (int c = file_.get(); c != 0; c = file_.get()) {
      if (!file_ || found.size() == longest) throw ImageError("its header has no end");
      found += static_cast<char>(c);
    }
    return found;
  }

  std::int32_t number() {
    std::array<char, 4> bytes{};
    file_.read(bytes.data(), bytes.size());
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<std::uint8_t>(bytes[i]);
    return static_cast<std::int32_t>(value);
  }

  std::ifstream file_;
  std::uint64_t bytes_;
  bool hasParts_ = false;
  bool isTiled_ = false;
};

}  // namespace

void requireSoundExrHeader(const std::filesystem::path& path) {
  Header(path).check();
}

}  // namespace gnomon::image
