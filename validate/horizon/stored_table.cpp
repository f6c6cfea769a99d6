#include "horizon/stored_table.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <string>

#include "common/error.h"
#include "common/parallel.h"
#include "common/text.h"
#include "image/images.h"

namespace gnomon::horizon {
namespace {

double largestCode(TableBits bits) {
  return bits == TableBits::eight ? 255 : 65535;
}

template <typename Entry>
Entry entryAt(const std::vector<std::uint8_t>& bytes, std::size_t entry) {
  Entry value;
  std::memcpy(&value, bytes.data() + entry * sizeof(Entry), sizeof(Entry));
  return value;
}

void checkFinite(std::span<const float> values) {
  const auto bad =
      std::find_if(values.begin(), values.end(), [](float v) { return !std::isfinite(v); });
  if (bad == values.end()) return;
  throw InputError(
      fmt::format("table: entry {} is {}, a finite value expected", bad - values.begin(), *bad));
}

template <typename Code>
void encode(std::span<const float> values, double low, double high, double largest,
            std::uint8_t* bytes) {
  const double scale = high > low ? largest / (high - low) : 0;
  constexpr std::size_t valuesAtOnce = 1 << 14;
  parallelFor(
      0, values.size(),
      [&](std::size_t i) {
        const auto code = static_cast<Code>(std::lround((values[i] - low) * scale));
        std::memcpy(bytes + i * sizeof(Code), &code, sizeof(Code));
      },
      valuesAtOnce);
}

}  // namespace

float StoredTable::value(std::size_t entry) const {
  if (bits == TableBits::thirtyTwo) return entryAt<float>(bytes, entry);
  const double code = bits == TableBits::eight ? entryAt<std::uint8_t>(bytes, entry)
                                               : entryAt<std::uint16_t>(bytes, entry);
  // lerp is exact at both ends, whatever the magnitudes.
  return static_cast<float>(
      std::lerp(static_cast<double>(low), static_cast<double>(high), code / largestCode(bits)));
}

void StoredTable::set(std::size_t entry, std::span<const float> values) {
  std::uint8_t* to = bytes.data() + entry * static_cast<std::size_t>(bits) / 8;
  switch (bits) {
    case TableBits::eight:
      encode<std::uint8_t>(values, low, high, largestCode(bits), to);
      break;
    case TableBits::sixteen:
      encode<std::uint16_t>(values, low, high, largestCode(bits), to);
      break;
    case TableBits::thirtyTwo:
      if (!values.empty()) std::memcpy(to, values.data(), values.size_bytes());
      break;
  }
}

StoredTable emptyTable(std::size_t entries, TableBits bits, float low, float high) {
  return {bits, low, high, std::vector<std::uint8_t>(entries * static_cast<std::size_t>(bits) / 8)};
}

StoredTable storeTable(std::span<const float> values, TableBits bits) {
  checkFinite(values);
  float low = 0;
  float high = 0;
  if (!values.empty()) {
    const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
    low = *least;
    high = *greatest;
  }
  StoredTable table = emptyTable(values.size(), bits, low, high);
  table.set(0, values);
  return table;
}

namespace {
namespace fs = std::filesystem;

constexpr int mostAzimuths = 1000;  // three digits in a channel's name
constexpr int rowsAtOnce = 16;      // what EXR's zip compression packs together

[[noreturn]] void refuse(const fs::path& file, const std::string& reason) {
  throw InputError(fmt::format("{}: {}", file.string(), oneLine(reason)));
}

/// How one entry of a table lies in the file. Converted by hand, since the image library scales
/// integers when it converts them.
image::NumberType pixelType(TableBits bits) {
  if (bits == TableBits::sixteen) return image::NumberType::uint32;
  return bits == TableBits::eight ? image::NumberType::half : image::NumberType::float32;
}

/// How it lies in the buffers handed to the image library: 32 bits each.
image::NumberType bufferType(TableBits bits) {
  return bits == TableBits::sixteen ? image::NumberType::uint32 : image::NumberType::float32;
}

std::size_t bytesAnEntry(TableBits bits) {
  return static_cast<std::size_t>(bits) / 8;
}

std::uint32_t bitsOf(float value) {
  std::uint32_t word = 0;
  std::memcpy(&word, &value, sizeof word);
  return word;
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

void checkConsistent(const fs::path& file, const StoredHorizons& tables) {
  const std::size_t entries = tables.entries();
  if (tables.width < 1 || tables.height < 1 || tables.layers < 1 || tables.layers > mostAzimuths ||
      tables.horizon.bits != tables.distance.bits || tables.horizon.entryCount() != entries ||
      tables.distance.entryCount() != entries) {
    refuse(file,
           fmt::format("cannot hold tables of {} x {} texels and {} azimuths with {} and {} "
                       "entries: both of width x height x azimuths entries of the same bits "
                       "and at most {} azimuths expected",
                       tables.width, tables.height, tables.layers, tables.horizon.entryCount(),
                       tables.distance.entryCount(), mostAzimuths));
  }
}

image::ExrDescription describe(const StoredHorizons& tables) {
  image::ExrDescription exr{tables.width, tables.height, {}, pixelType(tables.horizon.bits), {}};
  for (const char* table : {"distance", "horizon"}) {
    for (int m = 0; m < tables.layers; ++m) {
      exr.channels.push_back(fmt::format("{}.{:03}", table, m));
    }
  }
  exr.attributes["gnomon:azimuths"] = tables.layers;
  // As text, since EXR metadata of OpenImageIO holds no doubles.
  exr.attributes["gnomon:radiusTexels"] = fmt::format("{}", tables.radiusTexels);
  exr.attributes["gnomon:wrap"] = tables.wrap == relief::Wrap::repeat ? "repeat" : "clamp";
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
  const int channels = 2 * tables.layers;
  auto word = out.begin();
  for (int y = top; y < top + rows; ++y) {
    for (int x = 0; x < tables.width; ++x) {
      for (int c = 0; c < channels; ++c) {
        const StoredTable& table = c < tables.layers ? tables.distance : tables.horizon;
        const auto entry = tables.entry(c % tables.layers, x, tables.height - 1 - y);
        *word++ = wordFromEntry(table.bytes.data() + entry * bytesAnEntry(bits), bits);
      }
    }
  }
}

bool isExrName(const fs::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending == ".exr";
}

}  // namespace

void writeHorizons(const fs::path& file, const StoredHorizons& tables) {
  checkConsistent(file, tables);
  if (!isExrName(file)) refuse(file, "a name that ends in .exr expected");
  std::vector<std::uint32_t> buffer(static_cast<std::size_t>(tables.width) * 2 *
                                    static_cast<std::size_t>(tables.layers) * rowsAtOnce);
  const auto rows = [&](int top, int count) {
    gatherRows(tables, top, count, buffer);
    return buffer.data();
  };
  image::writeExr(file, describe(tables), {bufferType(tables.horizon.bits), rowsAtOnce, rows});
}

}  // namespace gnomon::horizon
