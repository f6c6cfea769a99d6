#include "horizon/stored_table.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "common/error.h"
#include "common/parallel.h"

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

}  // namespace gnomon::horizon
