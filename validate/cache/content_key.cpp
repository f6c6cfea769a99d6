#include "cache/content_key.h"

#include <fmt/core.h>
#include <xxhash.h>

namespace gnomon::cache {
namespace {

/// Longer inputs enter by their own key.
constexpr std::size_t longInput = 4096;

void appendNumber(std::string& bytes, std::uint64_t number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

}  // namespace

std::string ContentKey::text() const {
  return fmt::format("{:016x}{:016x}", high, low);
}

ContentKey keyOfBytes(std::string_view bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  return {hash.high64, hash.low64};
}

KeyBuilder& KeyBuilder::append(std::string_view name, char type, const void* data,
                               std::size_t size) {
  appendNumber(bytes_, name.size());
  bytes_ += name;
  bytes_ += type;
  appendNumber(bytes_, size);
  const std::string_view content(static_cast<const char*>(data), size);
  if (size <= longInput) {
    bytes_ += content;
  } else {
    const ContentKey key = keyOfBytes(content);
    appendNumber(bytes_, key.high);
    appendNumber(bytes_, key.low);
  }
  return *this;
}

}  // namespace gnomon::cache
