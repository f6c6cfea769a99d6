#include "common/memory.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <string_view>

#include "common/error.h"

namespace gnomon {
namespace {

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

std::uint64_t readNumber(const char* path) {
  std::ifstream file(path);
  std::uint64_t value = 0;
  return file >> value ? value : unlimited;
}

/// The number after a key in a file of keys and numbers.
std::uint64_t readKey(const char* path, std::string_view wanted, std::uint64_t fallback) {
  std::ifstream file(path);
  std::string key;
  std::uint64_t value = 0;
  while (file >> key >> value) {
    if (key == wanted) return value;
    file.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  return fallback;
}

std::uint64_t kernelAvailableBytes() {
  const std::uint64_t kibibytes = readKey("/proc/meminfo", "MemAvailable:", unlimited);
  return kibibytes == unlimited ? unlimited : kibibytes * 1024;
}

std::uint64_t controlGroupAvailableBytes() {
  const std::uint64_t limit = readNumber("/sys/fs/cgroup/memory.max");
  const std::uint64_t used = readNumber("/sys/fs/cgroup/memory.current");
  if (limit == unlimited || used == unlimited) return unlimited;
  // Pages of files that were read count as used, but the kernel gives them up first.
  const std::uint64_t cached = readKey("/sys/fs/cgroup/memory.stat", "inactive_file", 0);
  const std::uint64_t held = used - std::min(used, cached);
  return limit - std::min(limit, held);
}

}  // namespace

std::uint64_t availableMemoryBytes() {
  return std::min(kernelAvailableBytes(), controlGroupAvailableBytes());
}

std::uint64_t residentMemoryBytes() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t whole = 0;
  std::uint64_t residentPages = 0;
  if (!(file >> whole >> residentPages)) return 0;
  return residentPages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

void requireMemory(double bytes, const std::string& what) {
  const double available = static_cast<double>(availableMemoryBytes());
  if (!(bytes <= 0.9 * available)) {
    throw MemoryError(fmt::format("{}: needs {}, {} available", what, formatBytes(bytes),
                                  formatBytes(available)));
  }
}

std::string formatBytes(double bytes) {
  static constexpr std::array units = {"B", "kB", "MB", "GB", "TB", "PB"};
  std::size_t unit = 0;
  while (bytes >= 999.5 && unit + 1 < units.size()) {
    bytes /= 1000;
    ++unit;
  }
  if (bytes >= 999.5) return fmt::format("{:.3g} {}", bytes, units.back());
  const int decimals = unit == 0 || bytes >= 99.95 ? 0 : bytes >= 9.995 ? 1 : 2;
  return fmt::format("{:.{}f} {}", bytes, decimals, units.at(unit));
}

}  // namespace gnomon
