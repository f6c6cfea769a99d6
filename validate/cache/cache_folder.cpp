#include "cache/cache_folder.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <random>
#include <system_error>
#include <utility>
#include <vector>

#include "common/error.h"
#include "common/files/atomic_file.h"

namespace gnomon::cache {

namespace fs = std::filesystem;
namespace {

constexpr const char* limitFile = "limit";

struct File {
  fs::path path;
  std::uint64_t bytes = 0;
  fs::file_time_type used;
};

bool isEntryFolder(const fs::path& path) {
  const std::string name = path.filename().string();
  return name.size() == 2 && name.find_first_not_of("0123456789abcdef") == std::string::npos;
}

/// The files of one folder of entries. Another process may remove any of them meanwhile.
void addFiles(const fs::path& folder, std::vector<File>& files) {
  std::error_code failure;
  for (fs::directory_iterator it(folder, failure), end; !failure && it != end;
       it.increment(failure)) {
    std::error_code gone;
    if (it->path().extension() != ".entry" || !it->is_regular_file(gone)) continue;
    File file{it->path(), it->file_size(gone), {}};
    if (!gone) file.used = it->last_write_time(gone);
    if (!gone) files.push_back(std::move(file));
  }
}

std::vector<File> filesIn(const fs::path& folder) {
  std::vector<File> files;
  std::error_code failure;
  for (fs::directory_iterator it(folder, failure), end; !failure && it != end;
       it.increment(failure)) {
    if (isEntryFolder(it->path())) addFiles(it->path(), files);
  }
  return files;
}

CacheUsage usageOf(const std::vector<File>& files) {
  CacheUsage usage;
  for (const File& file : files) {
    ++usage.entries;
    usage.bytes += file.bytes;
  }
  return usage;
}

/// A number of bytes in a file of the folder; none where there is no such file.
std::optional<std::uint64_t> numberIn(const fs::path& file) {
  std::error_code failure;
  constexpr std::uintmax_t mostDigits = 100;
  const bool isFile = fs::is_regular_file(fs::symlink_status(file, failure));
  if (!isFile || fs::file_size(file, failure) > mostDigits) return std::nullopt;
  try {
    return parseBytes(readFile(file));
  } catch (const Error&) {
    return std::nullopt;  // a damaged number is none
  }
}

/// Removes entries until they take at most so many bytes.
CacheUsage removeOldest(const fs::path& folder, std::uint64_t bytes) {
  std::vector<File> files = filesIn(folder);
  CacheUsage usage = usageOf(files);
  std::sort(files.begin(), files.end(),
            [](const File& a, const File& b) { return a.used < b.used; });
  for (const File& file : files) {
    std::error_code failure;
    if (usage.bytes <= bytes) continue;
    fs::remove(file.path, failure);
    if (failure) continue;
    --usage.entries;
    usage.bytes -= file.bytes;
  }
  return usage;
}

std::optional<fs::path> variable(const char* name) {
  const char* value = std::getenv(name);
  if (value == nullptr || *value == '\0') return std::nullopt;
  return value;
}

/// A folder of the XDG Base Directory Specification: one that is not absolute is invalid there, and
/// ignored.
std::optional<fs::path> absoluteVariable(const char* name) {
  auto folder = variable(name);
  return folder && folder->is_absolute() ? folder : std::nullopt;
}

}  // namespace

std::optional<fs::path> standardCacheFolder() {
  if (auto chosen = variable("GNOMON_CACHE")) return chosen;
  if (const auto caches = absoluteVariable("XDG_CACHE_HOME")) return *caches / "gnomon";
  if (const auto home = absoluteVariable("HOME")) return *home / ".cache/gnomon";
  return std::nullopt;
}

CacheUsage usageOf(const fs::path& folder) {
  return usageOf(filesIn(folder));
}

std::uint64_t limitOf(const fs::path& folder) {
  return numberIn(folder / limitFile).value_or(standardCacheLimit);
}

void setLimit(const fs::path& folder, std::uint64_t bytes) {
  replaceFile(folder / limitFile, fmt::format("{}\n", bytes), Sync::later, folder);
}

void account(const fs::path& folder, std::uint64_t written, std::uint64_t limit) {
  constexpr std::uint64_t share = 16;
  std::random_device random;
  const std::uint64_t drawn =
      std::uniform_int_distribution<std::uint64_t>(1, std::max<std::uint64_t>(limit, 1))(random);
  if (written < limit / share && drawn > share * written) return;
  if (usageOf(folder).bytes > limit) removeOldest(folder, limit - limit / 8);
}

CacheUsage trimTo(const fs::path& folder, std::uint64_t bytes) {
  std::error_code failure;
  if (!fs::is_directory(folder, failure)) return {};
  removeLeftovers(folder);
  return removeOldest(folder, bytes);
}

std::uint64_t parseBytes(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, double>, 6> units = {
      {{"", 1}, {"B", 1}, {"kB", 1e3}, {"MB", 1e6}, {"GB", 1e9}, {"TB", 1e12}}};
  const auto fail = [&]() -> UsageError {
    return UsageError(
        fmt::format("\"{}\" found, a number of bytes expected, as 500MB or 4GB", text));
  };
  const std::string copy(text);
  char* end = nullptr;
  const double number = std::strtod(copy.c_str(), &end);
  std::string unit(end);
  std::erase_if(unit, [](char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; });
  const auto found = std::find_if(units.begin(), units.end(),
                                  [&](const auto& entry) { return entry.first == unit; });
  if (end == copy.c_str() || found == units.end()) throw fail();
  const double bytes = number * found->second;
  if (!(bytes >= 0 && bytes <= 1e18)) throw fail();
  return static_cast<std::uint64_t>(std::llround(bytes));
}

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
