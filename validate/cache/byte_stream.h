#pragma once

#include <concepts>
#include <cstdint>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace gnomon::cache {

/// Values as bytes and back, for entries that only the program that wrote them reads (its identity
/// is in their keys): native endian, and no versions.
///
/// A type says what it is made of once, for both directions, in a function beside it:
///
///   template <typename Stream, SameAs<Counts> T>
///   void fields(Stream& stream, T& counts) { stream(counts.truePositive, …); }

/// `T` is `U`, const or not: what a writer and a reader hand to `fields`.
template <typename T, typename U>
concept SameAs = std::same_as<std::remove_const_t<T>, U>;

/// A struct without padding, made of plain values only: named so where there are many of it.
template <typename T>
inline constexpr bool isPacked = false;

/// A value whose bytes are itself: copied as they are.
template <typename T>
concept PlainValue = std::is_arithmetic_v<T> || std::is_enum_v<T> || isPacked<T>;

/// Bytes that are no such values.
class DamagedBytes : public std::runtime_error {
 public:
  DamagedBytes() : std::runtime_error("bytes of another kind of value") {}
};

class ByteWriter {
 public:
  template <typename... T>
  void operator()(const T&... values) {
    (put(values), ...);
  }
  [[nodiscard]] std::string take() { return std::move(bytes_); }

 private:
  void append(const void* data, std::size_t size) {
    bytes_.append(static_cast<const char*>(data), size);
  }
  void putSize(std::size_t size) { put(static_cast<std::uint64_t>(size)); }

  template <PlainValue T>
  void put(const T& value) {
    append(&value, sizeof value);
  }
  void put(const std::string& text) {
    putSize(text.size());
    append(text.data(), text.size());
  }
  template <typename T>
  void put(const std::optional<T>& value) {
    put(value.has_value());
    if (value) put(*value);
  }
  template <typename T, typename Allocator>
  void put(const std::vector<T, Allocator>& values) {
    putSize(values.size());
    if constexpr (PlainValue<T>) {
      append(values.data(), values.size() * sizeof(T));
    } else {
      for (const T& value : values) put(value);
    }
  }
  template <typename T>
  void put(const T& value) {
    fields(*this, value);
  }

  std::string bytes_;
};

class ByteReader {
 public:
  /// @param bytes  outlive the reader
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  /// @throws DamagedBytes where they end too early
  template <typename... T>
  void operator()(T&... values) {
    (get(values), ...);
  }
  [[nodiscard]] bool isAtEnd() const { return rest_.empty(); }

 private:
  const char* next(std::size_t size) {
    if (size > rest_.size()) throw DamagedBytes();
    const char* data = rest_.data();
    rest_.remove_prefix(size);
    return data;
  }
  /// A count of things that take at least so many bytes each.
  std::size_t getSize(std::size_t bytesEach) {
    std::uint64_t size = 0;
    get(size);
    if (size > rest_.size() / bytesEach) throw DamagedBytes();
    return static_cast<std::size_t>(size);
  }

  template <PlainValue T>
  void get(T& value) {
    std::memcpy(&value, next(sizeof value), sizeof value);
  }
  /// Other bytes than 0 and 1 are no values of it.
  void get(bool& value) {
    const char byte = *next(1);
    if (byte != 0 && byte != 1) throw DamagedBytes();
    value = byte == 1;
  }
  void get(std::string& text) {
    const std::size_t size = getSize(1);
    text.assign(next(size), size);
  }
  template <typename T>
  void get(std::optional<T>& value) {
    bool isThere = false;
    get(isThere);
    value.reset();
    if (isThere) get(value.emplace());
  }
  template <typename T, typename Allocator>
  void get(std::vector<T, Allocator>& values) {
    if constexpr (PlainValue<T>) {
      values.resize(getSize(sizeof(T)));
      const std::size_t size = values.size() * sizeof(T);
      if (size > 0) std::memcpy(values.data(), next(size), size);
    } else {
      values.resize(getSize(1));
      for (T& value : values) get(value);
    }
  }
  template <typename T>
  void get(T& value) {
    fields(*this, value);
  }

  std::string_view rest_;
};

template <typename T>
std::string bytesOf(const T& value) {
  ByteWriter writer;
  writer(value);
  return writer.take();
}

/// @throws DamagedBytes where they are not exactly one such value
template <typename T>
T valueOf(std::string_view bytes) {
  T value{};
  ByteReader reader(bytes);
  reader(value);
  if (!reader.isAtEnd()) throw DamagedBytes();
  return value;
}

}  // namespace gnomon::cache
