#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <typeindex>

#include "cache/content_key.h"
#include "common/error.h"

namespace gnomon::study {

/// What a compiled shader takes in the driver, about.
constexpr std::uint64_t programBytes = 1 << 20;

/// What the cases of a sweep, or the studies of a command, share: values that took long to make,
/// kept in memory by the key of all that they depend on, so that a result never depends on whether
/// one was found. (What outlives the process is the cache's.) Who asked for a value holds it too:
/// what the store lets go stays valid for them. For one thread, and, since there are OpenGL's
/// objects among the values, for the life of a context.
class SceneStore {
 public:
  /// Values of one type that are held at most: a hierarchy's device holds one of the 1,024 keys of
  /// thread-specific data that a process has, and where none is left the next device fails.
  static constexpr int mostOfAType = 256;

  /// @param mostBytes  that the values may take together; the least recently used make room
  explicit SceneStore(std::uint64_t mostBytes = shareOfMemory());
  SceneStore(const SceneStore&) = delete;
  SceneStore& operator=(const SceneStore&) = delete;
  ~SceneStore() = default;

  /// A quarter of the memory that is available now.
  static std::uint64_t shareOfMemory();

  /// The value of a key, or what `make()` returns, which is kept. Where memory is too small for it,
  /// the others go, and it is made again.
  /// @param key    of this type of value alone
  /// @param make   returns a std::shared_ptr<const Value>
  /// @param bytes  `bytes(value)` is about what it takes
  template <typename Value, typename Make, typename Bytes>
  std::shared_ptr<const Value> get(const cache::ContentKey& key, const Make& make,
                                   const Bytes& bytes) {
    std::shared_ptr<const Value> value = held<Value>(key);
    if (value) return value;
    try {
      value = make();
    } catch (const MemoryError&) {
      if (entries_.empty()) throw;
      clear();
      value = make();
    }
    keep({key, typeid(Value)}, value, bytes(*value));
    return value;
  }

  /// The value of a key, if it is there.
  template <typename Value>
  std::shared_ptr<const Value> held(const cache::ContentKey& key) {
    return std::static_pointer_cast<const Value>(find({key, typeid(Value)}));
  }

  /// Whether a value of so many bytes would be kept, and leaves half of what is available now. What
  /// need not be held at once is otherwise better made piece by piece.
  [[nodiscard]] bool canHold(std::uint64_t bytes) const;
  /// Whether more cases of the same study may follow: what serves one case alone and takes as long
  /// to keep as to make need not be kept without.
  [[nodiscard]] bool expectsCases() const { return expectsCases_; }
  void expectCases(bool expects) { expectsCases_ = expects; }

  /// Lets go of everything.
  void clear();

 private:
  struct Name {
    cache::ContentKey key;
    std::type_index type;
    bool operator==(const Name&) const = default;
  };
  struct Entry {
    Name name;
    std::shared_ptr<const void> value;
    std::uint64_t bytes;
  };
  std::shared_ptr<const void> find(const Name& name);
  void keep(const Name& name, std::shared_ptr<const void> value, std::uint64_t bytes);
  void letGo(std::list<Entry>::const_iterator entry);

  std::uint64_t mostBytes_;
  std::uint64_t bytes_ = 0;
  bool expectsCases_ = false;
  std::list<Entry> entries_;  ///< the most recently used first
};

}  // namespace gnomon::study
