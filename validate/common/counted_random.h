#pragma once

#include <cstdint>
#include <string_view>

namespace gnomon {

/// Random numbers by count: the number of a place in a stream follows from seed, stream and place
/// alone. It is the same on every machine, whatever else is drawn and in whatever order.

/// The output of SplitMix64 (Steele, Lea & Flood 2014) that follows a state, modulo 2⁶⁴.
constexpr std::uint64_t splitMix64(std::uint64_t state) {
  std::uint64_t z = state + 0x9E3779B97F4A7C15U;
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
  return z ^ (z >> 31U);
}

/// The FNV-1a hash of a text, 64 bits.
constexpr std::uint64_t textHash(std::string_view text) {
  std::uint64_t hash = 0xCBF29CE484222325U;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3U;
  return hash;
}

/// A number in [0, 1), a whole multiple of 2⁻⁵³: the upper 53 bits of
/// s(s(s(seed) ⊕ textHash(stream)) ⊕ place), where s is splitMix64.
constexpr double randomUnit(std::uint64_t seed, std::string_view stream, std::uint64_t place) {
  const std::uint64_t bits = splitMix64(splitMix64(splitMix64(seed) ^ textHash(stream)) ^ place);
  return static_cast<double>(bits >> 11U) * 0x1p-53;
}

}  // namespace gnomon
