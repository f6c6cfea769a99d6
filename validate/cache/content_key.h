#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace gnomon::cache {

/// The name of a cached result: 128 bits of XXH3 over all that the result depends on. Two different
/// inputs share one with a probability of 2⁻¹²⁸; nobody gains by making them do so.
struct ContentKey {
  std::uint64_t high = 0;
  std::uint64_t low = 0;

  /// 32 hexadecimal digits.
  [[nodiscard]] std::string text() const;
  // NOLINTNEXTLINE(modernize-use-nullptr): it takes the comparison's own 0 for a pointer
  friend auto operator<=>(const ContentKey&, const ContentKey&) = default;
};

/// The key of some bytes.
ContentKey keyOfBytes(std::string_view bytes);

/// A number as its own bits are it: no padding, no pointer.
template <typename T>
concept PlainNumber = std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// Collects named inputs into a key. Every input enters with its name, its type and its length, so
/// that no two lists of inputs run into the same bytes. Floats enter by their bits: 0.1 and the
/// nearest float of it are two inputs.
class KeyBuilder {
 public:
  /// @param kind  of result: "mask"; results of two kinds never share a key
  explicit KeyBuilder(std::string_view kind) { add("kind", kind); }

  KeyBuilder& add(std::string_view name, std::string_view text) {
    return append(name, 't', text.data(), text.size());
  }
  KeyBuilder& add(std::string_view name, const ContentKey& key) {
    return add(name, std::span<const std::uint64_t>(std::array{key.high, key.low}));
  }
  template <PlainNumber T>
  KeyBuilder& add(std::string_view name, T number) {
    return append(name, typeOf<T>(), &number, sizeof number);
  }
  template <PlainNumber T>
  KeyBuilder& add(std::string_view name, std::span<const T> numbers) {
    return append(name, typeOf<T>(), numbers.data(), numbers.size_bytes());
  }
  template <PlainNumber T>
  KeyBuilder& add(std::string_view name, const std::vector<T>& numbers) {
    return add(name, std::span<const T>(numbers));
  }

  [[nodiscard]] ContentKey key() const { return keyOfBytes(bytes_); }

 private:
  template <typename T>
  static constexpr char typeOf() {
    if constexpr (std::is_enum_v<T>) return 'e';
    if constexpr (std::is_floating_point_v<T>) return 'f';
    return std::is_signed_v<T> ? 'i' : 'u';
  }
  KeyBuilder& append(std::string_view name, char type, const void* data, std::size_t size);

  std::string bytes_;
};

}  // namespace gnomon::cache
