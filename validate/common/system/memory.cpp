#include "common/system/memory.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>

#include "common/error.h"
#include "common/system/control_group.h"

namespace gnomon {
namespace {

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

// A study asks for some thousand small pieces, and every answer reads a dozen files of the kernel.
constexpr double tooSmallToAsk = 1e6;

/// The kernel's own estimate.
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

void requireMemory(double bytes, const std::string& what, const std::string& parameter) {
  if (bytes <= tooSmallToAsk) return;
  const double available = static_cast<double>(availableMemoryBytes());
  if (!(bytes <= 0.9 * available)) {
    throw MemoryError(
        fmt::format("{}: needs {}, {} available", what, formatBytes(bytes), formatBytes(available)),
        parameter);
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
