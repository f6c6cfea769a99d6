#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "cache/content_key.h"

namespace gnomon::cache {

/// The files of a cache: `FOLDER/ab/REST.entry`, named by key; `FOLDER/limit`, the bound that the
/// user chose; part files (see PartFile) while they are written. Nothing else in the folder is ever
/// touched.
///
/// Several processes may use one folder, of several machines too: an entry takes its name whole or
/// not at all, two that write the same entry write the same bytes, and an entry that another
/// process removed is one that is not there. They share no counter and wait for no lock.

/// The environment's GNOMON_CACHE, else `gnomon` in XDG_CACHE_HOME, else `.cache/gnomon` in the
/// home folder; none without any of them. A relative XDG_CACHE_HOME or HOME is as good as none.
std::optional<std::filesystem::path> standardCacheFolder();

/// Bytes that a cache may hold where the user chose nothing else.
constexpr std::uint64_t standardCacheLimit = 4'000'000'000;

struct CacheUsage {
  std::uint64_t entries = 0;
  std::uint64_t bytes = 0;  ///< of their files
};
CacheUsage usageOf(const std::filesystem::path& folder);

/// The bound that holds in the folder.
std::uint64_t limitOf(const std::filesystem::path& folder);
/// @throws InputError where it cannot be written
void setLimit(const std::filesystem::path& folder, std::uint64_t bytes);

/// Removes entries, those used longest ago first, until they take at most so many bytes; and what
/// killed writers left.
/// @return what is left
/// @throws InputError where the folder cannot be written
CacheUsage trimTo(const std::filesystem::path& folder, std::uint64_t bytes);

/// To be called after bytes were written: trims the folder where it holds more than its bound, to
/// seven eighths of it. All files are looked through by chance, with the probability
/// written / (limit / 16), so that together all writers do it once for each sixteenth of the bound
/// that they write: by so much a folder exceeds it on average before somebody looks.
void account(const std::filesystem::path& folder, std::uint64_t written, std::uint64_t limit);

/// "500 MB", "4GB", "1e9": a number of bytes with a decimal unit.
/// @throws UsageError for anything else, or more than 1e18
std::uint64_t parseBytes(std::string_view text);

/// An entry as its file holds it: a header of 64 bytes (magic, format version, the key that it
/// belongs to, length and XXH3 checksum of the content), then the content.
std::string sealedEntry(const ContentKey& key, std::string_view content);

constexpr std::size_t entryHeaderBytes = 64;

/// Whether a file that begins with so many bytes may hold the entry: its header tells of this key
/// and of just so many bytes behind it. To be asked before the rest is read, which may be of any
/// size.
bool mayBeEntry(const ContentKey& key, std::string_view header, std::uint64_t fileBytes);

/// The content of an entry's file; none where anything of it is not as it was written: cut, longer,
/// another entry's, a flipped bit.
/// @return a view into `file`
std::optional<std::string_view> openedEntry(const ContentKey& key, std::string_view file);

}  // namespace gnomon::cache
