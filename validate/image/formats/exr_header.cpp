#include "image/formats/exr_header.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <set>
#include <string>

#include "image/image_reader.h"

namespace gnomon::image {
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
