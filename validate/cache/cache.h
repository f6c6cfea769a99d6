#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "cache/byte_stream.h"
#include "cache/content_key.h"
#include "common/raw_vector.h"

namespace gnomon::cache {

/// What was found in a cache, and what was not.
struct CacheCounts {
  std::uint64_t hits = 0;
  std::uint64_t misses = 0;   ///< damaged ones among them
  std::uint64_t damaged = 0;  ///< entries that were not as they were written, and were removed

  friend CacheCounts operator-(CacheCounts a, const CacheCounts& b) {
    return {a.hits - b.hits, a.misses - b.misses, a.damaged - b.damaged};
  }
};

/// What computes the results of a cache.
struct CacheOwner {
  /// @param ofProgram    stands for everything of the program that a result may depend on
  /// @param ofProcessor  likewise of the machine
  // NOLINTNEXTLINE(google-explicit-constructor): a program alone is an owner
  CacheOwner(const ContentKey& ofProgram = {}, const ContentKey& ofProcessor = {})
      : program(ofProgram), processor(ofProcessor) {}
  ContentKey program, processor;
};

/// Which processors a result holds for: the one that computed it; or any, where a test shows for
/// every instruction set that its bytes are the same.
enum class HoldsOn { thisProcessor, anyProcessor };

/// Whether a look at an entry is counted: those of a run's measuring are, those of the reports that
/// may be written at the same time are not.
enum class Counted { yes, no };

/// Results that earlier runs left on disk, by the key of all that they depend on. A cache that
/// cannot be written, or is full, is one that keeps nothing more: a run never fails by it. What
/// stands in an entry's place and is none (damaged, of another size, a folder, a pipe) is one that
/// is not there, and is removed. All members may be called from several threads at once.
class Cache {
 public:
  /// Told once, in a line, why nothing more is kept.
  using Warning = std::function<void(const std::string&)>;

  /// One that holds nothing and keeps nothing: every result is computed.
  Cache() = default;
  /// @param limit  bytes that entries may take; the least recently used ones make room
  /// @param owner  is part of every key, see HoldsOn
  Cache(std::filesystem::path folder, std::uint64_t limit, const CacheOwner& owner, Warning warn);
  Cache(const Cache&) = delete;
  Cache& operator=(const Cache&) = delete;
  /// Holds the folder to its bound.
  ~Cache();

  [[nodiscard]] bool isOn() const { return !folder_.empty(); }
  /// Whether there is an entry, sound or not.
  [[nodiscard]] bool holds(const ContentKey& key, HoldsOn where = HoldsOn::thisProcessor) const;

  /// The value of an entry, counted as a hit or a miss. A damaged entry is removed.
  template <typename Value>
  std::optional<Value> find(const ContentKey& key, HoldsOn where = HoldsOn::thisProcessor,
                            Counted counted = Counted::yes) {
    const ContentKey own = ownKey(key, where);
    const std::optional<Loaded> entry = load(own, counted);
    if (!entry) return std::nullopt;
    try {
      return valueOf<Value>(entry->content);
    } catch (const DamagedBytes&) {
      discard(own, counted);
      return std::nullopt;
    }
  }
  template <typename Value>
  void keep(const ContentKey& key, const Value& value, HoldsOn where = HoldsOn::thisProcessor) {
    if (isOn()) save(ownKey(key, where), bytesOf(value));
  }
  /// The value of an entry, or what `compute()` returns, which is kept.
  template <typename Compute>
  auto remember(const ContentKey& key, const Compute& compute,
                HoldsOn where = HoldsOn::thisProcessor) {
    using Value = std::remove_cvref_t<decltype(compute())>;
    if (std::optional<Value> found = find<Value>(key, where)) return std::move(*found);
    Value value = compute();
    keep(key, value, where);
    return value;
  }

  [[nodiscard]] CacheCounts counts() const { return {hits_, misses_, damaged_}; }

 private:
  /// A sound entry.
  struct Loaded {
    RawVector<char> file;
    std::string_view content;  ///< of the file
  };
  std::optional<Loaded> load(const ContentKey& own, Counted counted);
  void save(const ContentKey& own, const std::string& content);
  /// The key with the owner's.
  [[nodiscard]] ContentKey ownKey(const ContentKey& key, HoldsOn where) const;
  /// Removes a damaged entry, and takes back its hit.
  void discard(const ContentKey& own, Counted counted);
  [[nodiscard]] std::filesystem::path pathOf(const ContentKey& own) const;
  void accountForWritten();

  std::filesystem::path folder_;  ///< empty: off
  std::uint64_t limit_ = 0;
  CacheOwner owner_;
  Warning warn_;
  std::mutex writing_;
  bool isFull_ = false;        ///< writing has failed
  std::uint64_t written_ = 0;  ///< bytes, not yet accounted for
  std::atomic<std::uint64_t> hits_ = 0;
  std::atomic<std::uint64_t> misses_ = 0;
  std::atomic<std::uint64_t> damaged_ = 0;
};

}  // namespace gnomon::cache
