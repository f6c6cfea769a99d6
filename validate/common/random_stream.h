#pragma once

#include <array>
#include <bit>
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

/// Random numbers that are the same on every machine: xoshiro256** (Blackman & Vigna 2018), a
/// period of 2²⁵⁶ - 1, in whole numbers alone. The standard library's generators are specified, its
/// distributions are not.
class RandomStream {
 public:
  using State = std::array<std::uint64_t, 4>;

  /// @param state  not all 0
  explicit RandomStream(const State& state) : state_(state) {}
  /// The state is the first four numbers of splitmix64 from the seed (Steele, Lea & Flood 2014).
  explicit RandomStream(std::uint64_t seed) {
    for (std::uint64_t& word : state_) {
      word = splitMix64(seed);
      seed += 0x9E3779B97F4A7C15U;
    }
  }

  /// 64 random bits.
  std::uint64_t next() {
    const std::uint64_t result = std::rotl(state_[1] * 5, 7) * 9;
    const std::uint64_t shifted = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= shifted;
    state_[3] = std::rotl(state_[3], 45);
    return result;
  }

  /// A whole number from 0 to below `count`, each as probable as the others: draws that would
  /// favour the small ones are thrown away.
  std::uint64_t below(std::uint64_t count) {
    const std::uint64_t surplus = (0 - count) % count;  // 2⁶⁴ mod count
    std::uint64_t draw = next();
    while (draw < surplus) draw = next();
    return draw % count;
  }

  /// A multiple of 2⁻⁵³ from 0 to below 1.
  double unit() { return static_cast<double>(next() >> 11) * 0x1p-53; }

 private:
  State state_{};
};

}  // namespace gnomon
