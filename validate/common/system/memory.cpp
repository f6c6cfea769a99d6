#include "common/system/memory.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <sstream>
#include <string_view>
#include <vector>

#include "common/error.h"

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

namespace fs = std::filesystem;
namespace {

constexpr std::uint64_t noLimit = std::numeric_limits<std::uint64_t>::max();

/// The files of one version of control groups.
struct Hierarchy {
  std::vector<const char*> limits;  ///< each a number, or a word where there is no limit
  const char* usage;
  const char* cachedKey;  ///< of memory.stat: file pages, those of the groups below among them
};

const Hierarchy& unified() {
  static const Hierarchy files{{"memory.max", "memory.high"}, "memory.current", "inactive_file"};
  return files;
}

const Hierarchy& legacy() {
  static const Hierarchy files{
      {"memory.limit_in_bytes"}, "memory.usage_in_bytes", "total_inactive_file"};
  return files;
}

std::uint64_t numberIn(const fs::path& path) {
  std::ifstream file(path);
  std::uint64_t value = 0;
  return file >> value ? value : noLimit;
}

std::uint64_t keyIn(const fs::path& path, std::string_view wanted, std::uint64_t fallback) {
  std::ifstream file(path);
  std::string key;
  std::uint64_t value = 0;
  while (file >> key >> value) {
    if (key == wanted) return value;
  }
  return fallback;
}

std::uint64_t availableInGroup(const fs::path& group, const Hierarchy& files) {
  const fs::path counts = group / "memory.stat";
  // What limits a group of the older hierarchy from above, even from where it cannot be seen.
  std::uint64_t limit = keyIn(counts, "hierarchical_memory_limit", noLimit);
  for (const char* name : files.limits) limit = std::min(limit, numberIn(group / name));
  const std::uint64_t usage = numberIn(group / files.usage);
  if (limit == noLimit || usage == noLimit) return noLimit;
  const std::uint64_t used = usage - std::min(usage, keyIn(counts, files.cachedKey, 0));
  return limit - std::min(limit, used);
}

/// The least of a group and all above it, up to the hierarchy's root.
std::uint64_t availableUpwards(const fs::path& root, const fs::path& group,
                               const Hierarchy& files) {
  std::uint64_t available = availableInGroup(root, files);
  fs::path place = root;
  for (const fs::path& part : group.relative_path()) {
    // Seen from a container, a group may lie outside of what is mounted: "/../other".
    if (part == "..") break;
    place /= part;
    available = std::min(available, availableInGroup(place, files));
  }
  return available;
}

bool hasMemory(std::string_view controllers) {
  std::istringstream list{std::string(controllers)};
  std::string name;
  while (std::getline(list, name, ',')) {
    if (name == "memory") return true;
  }
  return false;
}

}  // namespace

std::uint64_t controlGroupAvailableBytes(const fs::path& root, const std::string& membership) {
  std::uint64_t available = noLimit;
  std::istringstream lines(membership);
  std::string line;
  while (std::getline(lines, line)) {
    // "4:memory:/group" of the older hierarchy, "0::/group" of the unified one.
    const std::size_t first = line.find(':');
    const std::size_t second = first == std::string::npos ? first : line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const fs::path group = line.substr(second + 1);
    if (controllers.empty()) {
      available = std::min(available, availableUpwards(root, group, unified()));
      available = std::min(available, availableUpwards(root / "unified", group, unified()));
    } else if (hasMemory(controllers)) {
      available = std::min(available, availableUpwards(root / "memory", group, legacy()));
    }
  }
  return available;
}

std::uint64_t controlGroupAvailableBytes() {
  std::ifstream file("/proc/self/cgroup");
  std::ostringstream membership;
  membership << file.rdbuf();
  return controlGroupAvailableBytes("/sys/fs/cgroup", membership.str());
}

}  // namespace gnomon
