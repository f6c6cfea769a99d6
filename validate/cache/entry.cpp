#include "cache/entry.h"

#include <array>
#include <cstdint>
#include <cstring>

namespace gnomon::cache {
namespace {

struct Header {
  std::array<char, 8> magic{'g', 'n', 'o', 'm', 'o', 'n', 'c', '\n'};
  std::uint64_t version = 1;
  ContentKey key;
  std::uint64_t length = 0;
  ContentKey checksum;
  std::uint64_t unused = 0;

  bool operator==(const Header&) const = default;
};
static_assert(sizeof(Header) == entryHeaderBytes);

Header headerOf(const ContentKey& key, std::string_view content) {
  Header header;
  header.key = key;
  header.length = content.size();
  header.checksum = keyOfBytes(content);
  return header;
}

}  // namespace

std::string sealedEntry(const ContentKey& key, std::string_view content) {
  const Header header = headerOf(key, content);
  std::string file(reinterpret_cast<const char*>(&header), sizeof header);
  file += content;
  return file;
}

bool mayBeEntry(const ContentKey& key, std::string_view header, std::uint64_t fileBytes) {
  if (header.size() < sizeof(Header) || fileBytes < sizeof(Header)) return false;
  Header found;
  std::memcpy(&found, header.data(), sizeof found);
  Header expected;
  expected.key = key;
  expected.length = fileBytes - sizeof(Header);
  expected.checksum = found.checksum;
  return found == expected;
}

std::optional<std::string_view> openedEntry(const ContentKey& key, std::string_view file) {
  if (file.size() < sizeof(Header)) return std::nullopt;
  Header found;
  std::memcpy(&found, file.data(), sizeof found);
  const std::string_view content = file.substr(sizeof found);
  // The checksum last: it reads everything.
  if (!mayBeEntry(key, file, file.size())) return std::nullopt;
  if (found != headerOf(key, content)) return std::nullopt;
  return content;
}

}  // namespace gnomon::cache
