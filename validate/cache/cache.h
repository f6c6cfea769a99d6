#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <typeindex>

#include "cache/byte_stream.h"
#include "cache/content_key.h"
#include "common/error.h"
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

/// Values by the key of all that they depend on, on two levels, so that a result never depends on
/// whether one was found.
///
/// On disk: results of earlier runs, as bytes (byte_stream.h). A folder that cannot be written, or
/// is full, is one that keeps nothing more: a run never fails by it. What stands in an entry's
/// place and is none (damaged, of another size, a folder, a pipe) is one that is not there, and is
/// removed. From several threads at once.
///
/// In memory: what the cases of a sweep, or the studies of a command, share, as it is. Who asked
/// for a value owns it too: what the cache drops stays valid for them. For one thread, and, since
/// there are OpenGL's objects among the values, for the life of a context.
class Cache {
 public:
  /// Values of one type that are shared at most: a hierarchy's device takes one of the 1,024 keys
  /// of thread-specific data that a process has, and where none is left the next device fails.
  static constexpr int mostOfAType = 256;
  /// A quarter of the memory that is available now.
  static std::uint64_t shareOfMemory();

  /// Told once, in a line, why nothing more is kept.
  using Warning = std::function<void(const std::string&)>;

  /// One without a disk.
  /// @param memory  bytes that shared values may take; the least recently used make room
  explicit Cache(std::uint64_t memory = shareOfMemory()) : mostShared_(memory) {}
  /// @param limit  bytes that entries may take; the least recently used ones make room
  /// @param owner  is part of every key, see HoldsOn
  Cache(std::filesystem::path folder, std::uint64_t limit, const CacheOwner& owner, Warning warn);
  Cache(const Cache&) = delete;
  Cache& operator=(const Cache&) = delete;
  /// Trims the folder to its bound.
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

  /// The value of a key in memory, or what `make()` returns, which is shared with who asks next.
  /// Where memory is too small for it, the others go, and it is made again.
  /// @param key    of this type of value alone
  /// @param bytes  about what the value takes: a number, or a function of the value
  template <typename Make, typename Bytes>
  auto share(const ContentKey& key, const Make& make, const Bytes& bytes) {
    using Value = std::invoke_result_t<Make>;
    std::shared_ptr<const Value> value = shared<Value>(key);
    if (value) return value;
    try {
      value.reset(new Value(make()));
    } catch (const MemoryError&) {
      if (shared_.empty()) throw;
      dropShared();
      value.reset(new Value(make()));
    }
    if constexpr (std::is_invocable_v<Bytes, const Value&>) {
      addShared({key, typeid(Value)}, value, std::invoke(bytes, *value));
    } else {
      addShared({key, typeid(Value)}, value, bytes);
    }
    return value;
  }
  /// The value of a key in memory, if it is there.
  template <typename Value>
  std::shared_ptr<const Value> shared(const ContentKey& key) {
    return std::static_pointer_cast<const Value>(findShared({key, typeid(Value)}));
  }
  /// Whether a value of so many bytes would be shared, and leaves half of what is available now.
  /// Others are better made piece by piece.
  [[nodiscard]] bool canShare(std::uint64_t bytes) const;
  void dropShared();

  /// Whether more cases of the same study may follow: what serves one case alone and takes as long
  /// to keep as to make need not be kept without.
  [[nodiscard]] bool expectsCases() const { return expectsCases_; }
  void expectCases(bool expects) { expectsCases_ = expects; }

 private:
  /// Of a value in memory.
  struct Name {
    ContentKey key;
    std::type_index type;
    bool operator==(const Name&) const = default;
  };
  struct Shared {
    Name name;
    std::shared_ptr<const void> value;
    std::uint64_t bytes;
  };
  std::shared_ptr<const void> findShared(const Name& name);
  void addShared(const Name& name, std::shared_ptr<const void> value, std::uint64_t bytes);
  void drop(std::list<Shared>::const_iterator entry);

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
  [[nodiscard]] std::filesystem::path fileOf(const ContentKey& own) const;
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

  std::list<Shared> shared_;  ///< the most recently used first
  std::uint64_t mostShared_;
  std::uint64_t sharedBytes_ = 0;
  bool expectsCases_ = false;
};

}  // namespace gnomon::cache
