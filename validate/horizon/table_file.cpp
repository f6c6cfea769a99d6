#include "horizon/table_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/text/one_line.h"
#include "image/channel_image.h"
#include "image/image_file.h"

namespace gnomon {
namespace {
namespace fs = std::filesystem;

constexpr int mostAzimuths = 1000;  // three digits in a channel's name
constexpr int rowsAtOnce = 16;      // what EXR's zip compression packs together

[[noreturn]] void refuse(const fs::path& path, const std::string& reason) {
  throw InputError(fmt::format("{}: {}", path.string(), oneLine(reason)));
}

/// How one entry of a table lies in the file. Converted by hand, since the image library scales
/// integers when it converts them.
NumberType pixelType(TableBits bits) {
  if (bits == TableBits::sixteen) return NumberType::uint32;
  return bits == TableBits::eight ? NumberType::half : NumberType::float32;
}

/// How it lies in the buffers handed to the image library: 32 bits each.
NumberType bufferType(TableBits bits) {
  return bits == TableBits::sixteen ? NumberType::uint32 : NumberType::float32;
}

std::size_t bytesAnEntry(TableBits bits) {
  return static_cast<std::size_t>(bits) / 8;
}

std::uint32_t bitsOf(float value) {
  std::uint32_t word = 0;
  std::memcpy(&word, &value, sizeof word);
  return word;
}

float floatOf(std::uint32_t word) {
  float value = 0;
  std::memcpy(&value, &word, sizeof value);
  return value;
}

/// A buffer word from an entry's bytes.
std::uint32_t wordFromEntry(const std::uint8_t* entry, TableBits bits) {
  if (bits == TableBits::eight) return bitsOf(*entry);
  std::uint32_t word = 0;
  std::uint16_t code = 0;
  if (bits == TableBits::sixteen) {
    std::memcpy(&code, entry, sizeof code);
    return code;
  }
  std::memcpy(&word, entry, sizeof word);
  return word;
}

/// An entry's bytes from a buffer word; false where the word is no such entry.
bool entryFromWord(std::uint32_t word, TableBits bits, std::uint8_t* entry) {
  if (bits == TableBits::sixteen) {
    const auto code = static_cast<std::uint16_t>(word);
    std::memcpy(entry, &code, sizeof code);
    return code == word;
  }
  const float value = floatOf(word);
  if (!std::isfinite(value)) return false;
  if (bits == TableBits::eight) {
    if (!(value >= 0 && value <= 255 && value == std::floor(value))) return false;
    *entry = static_cast<std::uint8_t>(value);
    return true;
  }
  std::memcpy(entry, &word, sizeof word);
  return true;
}

/// Where one channel of the file lives in the tables.
struct Channel {
  bool isDistance;
  int azimuth;
};

std::string channelName(Channel channel) {
  return fmt::format("{}.{:03}", channel.isDistance ? "distance" : "horizon", channel.azimuth);
}

std::size_t entryIndex(const StoredHorizons& tables, int azimuth, int row, int x) {
  const auto width = static_cast<std::size_t>(tables.width);
  const auto height = static_cast<std::size_t>(tables.height);
  return (static_cast<std::size_t>(azimuth) * height + static_cast<std::size_t>(row)) * width +
         static_cast<std::size_t>(x);
}

void checkConsistent(const fs::path& path, const StoredHorizons& tables) {
  const std::size_t entries = entryIndex(tables, tables.azimuths, 0, 0);
  if (tables.width < 1 || tables.height < 1 || tables.azimuths < 1 ||
      tables.azimuths > mostAzimuths || tables.horizon.bits != tables.distance.bits ||
      tables.horizon.entryCount() != entries || tables.distance.entryCount() != entries) {
    refuse(path,
           fmt::format("cannot hold tables of {} x {} texels and {} azimuths with {} and {} "
                       "entries: both of width x height x azimuths entries of the same bits "
                       "and at most {} azimuths expected",
                       tables.width, tables.height, tables.azimuths, tables.horizon.entryCount(),
                       tables.distance.entryCount(), mostAzimuths));
  }
}

ExrDescription describe(const StoredHorizons& tables) {
  ExrDescription exr{tables.width, tables.height, {}, pixelType(tables.horizon.bits), {}};
  for (int c = 0; c < 2 * tables.azimuths; ++c) {
    const Channel channel{c < tables.azimuths, c % tables.azimuths};
    exr.channels.push_back(channelName(channel));
  }
  exr.attributes["gnomon:azimuths"] = tables.azimuths;
  // As text, since EXR metadata of OpenImageIO holds no doubles.
  exr.attributes["gnomon:radiusTexels"] = fmt::format("{}", tables.radiusTexels);
  exr.attributes["gnomon:wrap"] = tables.wrap == Wrap::repeat ? "repeat" : "clamp";
  exr.attributes["gnomon:bits"] = static_cast<int>(tables.horizon.bits);
  exr.attributes["gnomon:horizonLow"] = tables.horizon.low;
  exr.attributes["gnomon:horizonHigh"] = tables.horizon.high;
  exr.attributes["gnomon:distanceLow"] = tables.distance.low;
  exr.attributes["gnomon:distanceHigh"] = tables.distance.high;
  return exr;
}

/// The image's rows [top, top + rows) from the tables, channels innermost. The image's first row is
/// the tables' last, as in a height image.
void gatherRows(const StoredHorizons& tables, int top, int rows, std::vector<std::uint32_t>& out) {
  const TableBits bits = tables.horizon.bits;
  const int channels = 2 * tables.azimuths;
  auto word = out.begin();
  for (int y = top; y < top + rows; ++y) {
    for (int x = 0; x < tables.width; ++x) {
      for (int c = 0; c < channels; ++c) {
        const StoredTable& table = c < tables.azimuths ? tables.distance : tables.horizon;
        const auto entry = entryIndex(tables, c % tables.azimuths, tables.height - 1 - y, x);
        *word++ = wordFromEntry(table.bytes.data() + entry * bytesAnEntry(bits), bits);
      }
    }
  }
}

/// An attribute of exactly this type.
template <typename Value>
Value readAttribute(const fs::path& path, const ImageFacts& facts, const std::string& name) {
  const auto found = facts.attributes.find(name);
  const Value* value =
      found == facts.attributes.end() ? nullptr : std::get_if<Value>(&found->second);
  if (!value) refuse(path, fmt::format("no attribute {}: not tables that Gnomon wrote", name));
  return *value;
}

float readFloat(const fs::path& path, const ImageFacts& facts, const std::string& name) {
  const auto value = readAttribute<float>(path, facts, name);
  if (!std::isfinite(value)) refuse(path, fmt::format("{} is {}, not finite", name, value));
  return value;
}

TableBits readBits(const fs::path& path, const ImageFacts& facts) {
  const int bits = readAttribute<int>(path, facts, "gnomon:bits");
  if (bits != 8 && bits != 16 && bits != 32) {
    refuse(path, fmt::format("gnomon:bits is {}, 8, 16 or 32 expected", bits));
  }
  return static_cast<TableBits>(bits);
}

Wrap readWrap(const fs::path& path, const ImageFacts& facts) {
  const std::string wrap = readAttribute<std::string>(path, facts, "gnomon:wrap");
  if (wrap != "repeat" && wrap != "clamp") {
    refuse(path, fmt::format("gnomon:wrap is '{}', repeat or clamp expected", wrap));
  }
  return wrap == "repeat" ? Wrap::repeat : Wrap::clamp;
}

double readRadius(const fs::path& path, const ImageFacts& facts) {
  const std::string text = readAttribute<std::string>(path, facts, "gnomon:radiusTexels");
  const char* end = text.data() + text.size();
  double radius = 0;
  const auto parsed = std::from_chars(text.data(), end, radius);
  if (parsed.ec != std::errc() || parsed.ptr != end || !(radius > 0) || !std::isfinite(radius)) {
    refuse(path, fmt::format("gnomon:radiusTexels is '{}', a number over 0 expected", text));
  }
  return radius;
}

StoredTable readRange(const fs::path& path, const ImageFacts& facts, TableBits bits,
                      const std::string& name) {
  StoredTable table;
  table.bits = bits;
  table.low = readFloat(path, facts, fmt::format("gnomon:{}Low", name));
  table.high = readFloat(path, facts, fmt::format("gnomon:{}High", name));
  if (table.low > table.high) {
    refuse(path, fmt::format("gnomon:{}Low is {}, at most gnomon:{}High = {} expected", name,
                             table.low, name, table.high));
  }
  return table;
}

/// Everything but the entries.
StoredHorizons readHeader(const fs::path& path, const ImageFacts& facts) {
  StoredHorizons tables;
  tables.azimuths = readAttribute<int>(path, facts, "gnomon:azimuths");
  tables.radiusTexels = readRadius(path, facts);
  tables.wrap = readWrap(path, facts);
  const TableBits bits = readBits(path, facts);
  tables.horizon = readRange(path, facts, bits, "horizon");
  tables.distance = readRange(path, facts, bits, "distance");
  tables.width = facts.data.width;
  tables.height = facts.data.height;
  if (tables.azimuths < 1 || tables.azimuths > mostAzimuths ||
      facts.channelCount() != 2 * tables.azimuths || tables.width < 1 || tables.height < 1 ||
      facts.depth > 1 || facts.isDeep) {
    refuse(path, fmt::format("{} x {} pixels with {} channels for gnomon:azimuths = {}, two flat "
                             "channels an azimuth expected",
                             tables.width, tables.height, facts.channelCount(), tables.azimuths));
  }
  const std::string expected = nameOf(pixelType(bits));
  if (std::any_of(facts.channelNumbers.begin(), facts.channelNumbers.end(),
                  [&](const std::string& found) { return found != expected; })) {
    refuse(path, fmt::format("pixels are {}, {} expected for gnomon:bits = {}", facts.numbers,
                             expected, static_cast<int>(bits)));
  }
  return tables;
}

/// Which table entry each of the file's channels holds: the image library may reorder them.
std::vector<Channel> channelsOf(const fs::path& path, const ImageFacts& facts, int azimuths) {
  std::vector<Channel> channels(facts.channels.size());
  for (const bool isDistance : {false, true}) {
    for (int m = 0; m < azimuths; ++m) {
      const std::string name = channelName({isDistance, m});
      const int found = facts.channel(name);
      if (found < 0) refuse(path, fmt::format("no channel {}", name));
      channels[static_cast<std::size_t>(found)] = {isDistance, m};
    }
  }
  return channels;
}

void scatterRows(const fs::path& path, const std::uint32_t* word, int top, int rows,
                 const std::vector<Channel>& channels, StoredHorizons& tables) {
  const TableBits bits = tables.horizon.bits;
  for (int y = top; y < top + rows; ++y) {
    for (int x = 0; x < tables.width; ++x) {
      for (const Channel channel : channels) {
        StoredTable& table = channel.isDistance ? tables.distance : tables.horizon;
        const auto entry = entryIndex(tables, channel.azimuth, tables.height - 1 - y, x);
        if (!entryFromWord(*word++, bits, table.bytes.data() + entry * bytesAnEntry(bits))) {
          refuse(path, fmt::format("pixel ({}, {}) of channel {} is no code of {} bits", x, y,
                                   channelName(channel), static_cast<int>(bits)));
        }
      }
    }
  }
}

void readPixels(const fs::path& path, ImageFile& image, const ImageFacts& facts,
                StoredHorizons& tables) {
  const std::vector<Channel> channels = channelsOf(path, facts, tables.azimuths);
  const auto scatter = [&](const std::uint32_t* words, int top, int rows) {
    scatterRows(path, words, top, rows, channels, tables);
  };
  image.readBands<std::uint32_t>(0, facts.channelCount(), bufferType(tables.horizon.bits), scatter);
}

bool isExrName(const fs::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending == ".exr";
}

}  // namespace

void writeHorizons(const fs::path& path, const StoredHorizons& tables) {
  checkConsistent(path, tables);
  if (!isExrName(path)) refuse(path, "a name that ends in .exr expected");
  std::vector<std::uint32_t> buffer(static_cast<std::size_t>(tables.width) * 2 *
                                    static_cast<std::size_t>(tables.azimuths) * rowsAtOnce);
  const auto rows = [&](int top, int count) {
    gatherRows(tables, top, count, buffer);
    return buffer.data();
  };
  writeExr(path, describe(tables), {bufferType(tables.horizon.bits), rowsAtOnce, rows});
}

StoredHorizons readHorizons(const fs::path& path) {
  ImageFile image(path);
  if (image.format() != ImageFormat::exr) {
    refuse(path,
           fmt::format("a picture as {} found, tables in EXR expected", nameOf(image.format())));
  }
  const ImageFacts facts = image.facts();
  StoredHorizons tables = readHeader(path, facts);
  image.requireReadable(2.0 * tables.azimuths *
                        static_cast<double>(bytesAnEntry(tables.horizon.bits)));
  const std::size_t entries = entryIndex(tables, tables.azimuths, 0, 0);
  tables.horizon.bytes.resize(entries * bytesAnEntry(tables.horizon.bits));
  tables.distance.bytes.resize(entries * bytesAnEntry(tables.distance.bits));
  readPixels(path, image, facts, tables);
  return tables;
}

}  // namespace gnomon
