#include "cache/cache.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <iterator>
#include <system_error>
#include <utility>

#include "cache/cache_folder.h"
#include "common/files/atomic_file.h"
#include "common/system/memory.h"

namespace gnomon::cache {

namespace fs = std::filesystem;
namespace {

/// Bytes from an open file, as many as there is room for; false where it has fewer.
bool readAll(int file, char* to, std::size_t bytes) {
  while (bytes > 0) {
    const ssize_t got = ::read(file, to, bytes);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    to += got;
    bytes -= static_cast<std::size_t>(got);
  }
  return true;
}

/// What stands in an entry's place.
struct Found {
  bool isAny = false;
  std::optional<RawVector<char>> file;  ///< none: not an entry of this key
};

/// The bytes of an entry from an open file. Kind, size and header are looked at before room is
/// made: a file may have grown to any size.
/// @throws MemoryError for one that does not fit
std::optional<RawVector<char>> entryIn(int file, const ContentKey& own, std::uint64_t limit) {
  struct stat state {};
  if (::fstat(file, &state) != 0 || !S_ISREG(state.st_mode)) return std::nullopt;
  const auto bytes = static_cast<std::uint64_t>(state.st_size);
  std::array<char, entryHeaderBytes> header{};
  if (bytes > limit || bytes < header.size()) return std::nullopt;
  if (!readAll(file, header.data(), header.size())) return std::nullopt;
  if (!mayBeEntry(own, {header.data(), header.size()}, bytes)) return std::nullopt;
  constexpr std::uint64_t small = 1 << 24;  // is not worth asking for
  if (bytes > small) requireMemory(static_cast<double>(bytes), "a cache entry");
  RawVector<char> content(static_cast<std::size_t>(bytes));
  std::copy(header.begin(), header.end(), content.data());
  if (!readAll(file, content.data() + header.size(), content.size() - header.size())) {
    return std::nullopt;
  }
  return content;
}

Found contentOf(const fs::path& path, const ContentKey& own, std::uint64_t limit) {
  struct stat state {};
  if (::lstat(path.c_str(), &state) != 0) return {};
  Found found{true, std::nullopt};
  // No device is ever opened; a pipe that takes the file's place meanwhile does not block.
  if (!S_ISREG(state.st_mode)) return found;
  const int file = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return {errno != ENOENT && errno != EACCES, std::nullopt};
  try {
    found.file = entryIn(file, own, limit);
  } catch (const MemoryError&) {
    found.isAny = false;  // sound or not, it is of no use here
  }
  ::close(file);
  return found;
}

}  // namespace

Cache::Cache(fs::path folder, std::uint64_t limit, const CacheOwner& owner, Warning warn)
    : folder_(std::move(folder)),
      limit_(limit),
      owner_(owner),
      warn_(std::move(warn)),
      mostShared_(shareOfMemory()) {
  // A writer fills its file in the folder itself: so one look finds all that killed ones left.
  removeLeftovers(folder_);
}

Cache::~Cache() {
  accountForWritten();
}

ContentKey Cache::ownKey(const ContentKey& key, HoldsOn where) const {
  KeyBuilder own("entry");
  own.add("program", owner_.program).add("key", key);
  if (where == HoldsOn::thisProcessor) own.add("processor", owner_.processor);
  return own.key();
}

fs::path Cache::fileOf(const ContentKey& own) const {
  const std::string name = own.text();
  return folder_ / name.substr(0, 2) / (name.substr(2) + ".entry");
}

bool Cache::holds(const ContentKey& key, HoldsOn where) const {
  std::error_code failure;
  return isOn() && fs::exists(fileOf(ownKey(key, where)), failure);
}

std::optional<Cache::Loaded> Cache::load(const ContentKey& own, Counted counted) {
  if (!isOn()) return std::nullopt;
  const fs::path path = fileOf(own);
  Found found = contentOf(path, own, limit_);
  if (!found.isAny) {
    if (counted == Counted::yes) ++misses_;
    return std::nullopt;
  }
  std::optional<std::string_view> content;
  if (found.file) content = openedEntry(own, {found.file->data(), found.file->size()});
  if (counted == Counted::yes) ++hits_;
  if (!content) {
    discard(own, counted);
    return std::nullopt;
  }
  std::error_code ignored;  // in a folder that cannot be written its age stays
  fs::last_write_time(path, fs::file_time_type::clock::now(), ignored);
  return Loaded{std::move(*found.file), *content};
}

void Cache::discard(const ContentKey& own, Counted counted) {
  if (counted == Counted::yes) {
    --hits_;
    ++misses_;
    ++damaged_;
  }
  std::error_code ignored;
  // Whatever stands in an entry's place: the name is the cache's own.
  fs::remove_all(fileOf(own), ignored);
}

void Cache::accountForWritten() {
  if (written_ == 0) return;
  try {
    account(folder_, std::exchange(written_, 0), limit_);
  } catch (const Error&) {
    // The next run that can write will.
  }
}

void Cache::save(const ContentKey& own, const std::string& content) {
  const std::string file = sealedEntry(own, content);
  const std::lock_guard lock(writing_);
  if (isFull_ || file.size() > limit_) return;
  const fs::path path = fileOf(own);
  std::error_code failure;
  // One that could not be removed: this entry is not kept, others are.
  if (fs::is_directory(fs::symlink_status(path, failure))) return;
  try {
    // A checksum tells an entry that a power cut has damaged.
    replaceFile(path, file, Sync::later, folder_);
  } catch (const Error& error) {
    isFull_ = true;
    if (warn_) warn_(fmt::format("the cache keeps nothing more: {}", error.what()));
    return;
  }
  written_ += file.size();
  constexpr std::uint64_t enough = 64'000'000;
  if (written_ > std::min(enough, limit_ / 8)) accountForWritten();
}

std::uint64_t Cache::shareOfMemory() {
  return availableMemoryBytes() / 4;
}

bool Cache::canShare(std::uint64_t bytes) const {
  return bytes <= mostShared_ && bytes <= availableMemoryBytes() / 2;
}

void Cache::dropShared() {
  shared_.clear();
  sharedBytes_ = 0;
}

std::shared_ptr<const void> Cache::findShared(const Name& name) {
  const auto found = std::find_if(shared_.begin(), shared_.end(),
                                  [&](const Shared& entry) { return entry.name == name; });
  if (found == shared_.end()) return nullptr;
  shared_.splice(shared_.begin(), shared_, found);
  return found->value;
}

void Cache::drop(std::list<Shared>::const_iterator entry) {
  sharedBytes_ -= entry->bytes;
  shared_.erase(entry);
}

void Cache::addShared(const Name& name, std::shared_ptr<const void> value, std::uint64_t bytes) {
  if (bytes > mostShared_) return;
  while (sharedBytes_ > mostShared_ - bytes) drop(std::prev(shared_.end()));
  const auto isOfType = [&](const Shared& entry) { return entry.name.type == name.type; };
  if (std::count_if(shared_.begin(), shared_.end(), isOfType) == mostOfAType) {
    drop(std::prev(std::find_if(shared_.rbegin(), shared_.rend(), isOfType).base()));
  }
  shared_.push_front({name, std::move(value), bytes});
  sharedBytes_ += bytes;
}

}  // namespace gnomon::cache
