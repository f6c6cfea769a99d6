#include "relief/stored_table.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "common/error.h"

namespace gnomon {
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

void checkFinite(const std::vector<float>& values) {
  const auto bad =
      std::find_if(values.begin(), values.end(), [](float v) { return !std::isfinite(v); });
  if (bad == values.end()) return;
  throw InputError(
      fmt::format("table: entry {} is {}, a finite value expected", bad - values.begin(), *bad));
}

template <typename Code>
std::vector<std::uint8_t> encode(const std::vector<float>& values, double low, double high,
                                 double largest) {
  std::vector<std::uint8_t> bytes(values.size() * sizeof(Code));
  const double scale = high > low ? largest / (high - low) : 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto code = static_cast<Code>(std::lround((values[i] - low) * scale));
    std::memcpy(bytes.data() + i * sizeof(Code), &code, sizeof(Code));
  }
  return bytes;
}

std::vector<std::uint8_t> copyBytes(const std::vector<float>& values) {
  std::vector<std::uint8_t> bytes(values.size() * sizeof(float));
  if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
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

StoredTable storeTable(const std::vector<float>& values, TableBits bits) {
  checkFinite(values);
  StoredTable table;
  table.bits = bits;
  if (!values.empty()) {
    const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
    table.low = *least;
    table.high = *greatest;
  }
  switch (bits) {
    case TableBits::eight:
      table.bytes = encode<std::uint8_t>(values, table.low, table.high, largestCode(bits));
      break;
    case TableBits::sixteen:
      table.bytes = encode<std::uint16_t>(values, table.low, table.high, largestCode(bits));
      break;
    case TableBits::thirtyTwo:
      table.bytes = copyBytes(values);
      break;
  }
  return table;
}

}  // namespace gnomon
