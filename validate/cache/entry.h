#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "cache/content_key.h"

namespace gnomon::cache {

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
