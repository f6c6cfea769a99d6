#include "cache/cache.h"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>
#include <system_error>
#include <utility>

#include "cache/cache_folder.h"
#include "cache/entry.h"
#include "common/atomic_file.h"
#include "common/error.h"

namespace gnomon {
namespace fs = std::filesystem;
namespace {

/// The whole file; none where it is not there or cannot be read.
std::optional<RawVector<char>> contentOf(const fs::path& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) return std::nullopt;
  const std::streamoff size = file.tellg();
  if (size < 0) return std::nullopt;
  RawVector<char> content(static_cast<std::size_t>(size));
  file.seekg(0);
  file.read(content.data(), size);
  if (!file) return std::nullopt;
  return content;
}

}  // namespace

Cache::Cache(fs::path folder, std::uint64_t limit, const ContentKey& program, Warning warn)
    : folder_(std::move(folder)), limit_(limit), program_(program), warn_(std::move(warn)) {}

Cache::~Cache() {
  accountForWritten();
}

ContentKey Cache::ownKey(const ContentKey& key) const {
  return KeyBuilder("entry").add("program", program_).add("key", key).key();
}

fs::path Cache::pathOf(const ContentKey& own) const {
  const std::string name = own.text();
  return folder_ / name.substr(0, 2) / (name.substr(2) + ".entry");
}

bool Cache::holds(const ContentKey& key) const {
  std::error_code failure;
  return isOn() && fs::exists(pathOf(ownKey(key)), failure);
}

std::optional<Cache::Loaded> Cache::load(const ContentKey& key) {
  if (!isOn()) return std::nullopt;
  const ContentKey own = ownKey(key);
  const fs::path path = pathOf(own);
  std::optional<RawVector<char>> file = contentOf(path);
  if (!file) {
    ++misses_;
    return std::nullopt;
  }
  const auto content = openedEntry(own, {file->data(), file->size()});
  ++hits_;
  if (!content) {
    discard(key);
    return std::nullopt;
  }
  std::error_code ignored;  // in a folder that cannot be written its age stays
  fs::last_write_time(path, fs::file_time_type::clock::now(), ignored);
  return Loaded{std::move(*file), *content};
}

void Cache::discard(const ContentKey& key) {
  --hits_;
  ++misses_;
  ++damaged_;
  std::error_code ignored;
  fs::remove(pathOf(ownKey(key)), ignored);
}

void Cache::accountForWritten() {
  if (written_ == 0) return;
  try {
    account(folder_, std::exchange(written_, 0), limit_);
  } catch (const Error&) {
    // The next run that can write will.
  }
}

void Cache::save(const ContentKey& key, const std::string& content) {
  const ContentKey own = ownKey(key);
  const std::string file = sealedEntry(own, content);
  const std::lock_guard lock(writing_);
  if (isFull_ || file.size() > limit_) return;
  try {
    writeTextAtomically(pathOf(own), file);
  } catch (const Error& error) {
    isFull_ = true;
    if (warn_) warn_(fmt::format("the cache keeps nothing more: {}", error.what()));
    return;
  }
  written_ += file.size();
  constexpr std::uint64_t enough = 64'000'000;
  if (written_ > std::min(enough, limit_ / 8)) accountForWritten();
}

}  // namespace gnomon
