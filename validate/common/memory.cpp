#include "common/memory.h"

#include <fmt/core.h>

#include <array>
#include <fstream>
#include <limits>

#include "common/error.h"

namespace gnomon {
namespace {

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

std::uint64_t readNumber(const char* path) {
  std::ifstream file(path);
  std::uint64_t value = 0;
  return file >> value ? value : unlimited;
}

std::uint64_t kernelAvailableBytes() {
  std::ifstream file("/proc/meminfo");
  std::string key;
  std::uint64_t kibibytes = 0;
  while (file >> key >> kibibytes) {
    if (key == "MemAvailable:") return kibibytes * 1024;
    file.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  return unlimited;
}

std::uint64_t controlGroupAvailableBytes() {
  const std::uint64_t limit = readNumber("/sys/fs/cgroup/memory.max");
  const std::uint64_t used = readNumber("/sys/fs/cgroup/memory.current");
  if (limit == unlimited || used == unlimited) return unlimited;
  return limit > used ? limit - used : 0;
}

}  // namespace

std::uint64_t availableMemoryBytes() {
  return std::min(kernelAvailableBytes(), controlGroupAvailableBytes());
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
  const int decimals = unit == 0 || bytes >= 99.95 ? 0 : bytes >= 9.995 ? 1 : 2;
  return fmt::format("{:.{}f} {}", bytes, decimals, units.at(unit));
}

}  // namespace gnomon
