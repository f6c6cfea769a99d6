#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace gnomon {

/// Bytes that this process may still take: the kernel's estimate of available memory
/// (/proc/meminfo, MemAvailable), or what the control groups leave where that is less.
std::uint64_t availableMemoryBytes();

/// Bytes that this process holds in memory now (/proc/self/statm); 0 where that cannot be told.
std::uint64_t residentMemoryBytes();

/// Refuses a request that cannot fit, before anything is allocated. A megabyte and less always
/// fits: the system is not asked.
/// @param bytes  what the request would take
/// @param what       what is asked for
/// @param parameter  that makes it smaller, as Error has it; none, if empty
/// @throws MemoryError with both figures if `bytes` exceeds nine tenths of the available memory
void requireMemory(double bytes, const std::string& what, const std::string& parameter = {});

/// "1.0 MB", "2.51 GB": decimal units as the papers use them, three significant digits.
std::string formatBytes(double bytes);

/// Bytes of memory that the control groups of a process leave it: of its own group and of every
/// group above it, each
///   limit − (usage − file pages that the kernel gives up first),
/// the least of them counts. Read are, of the unified hierarchy (v2), `memory.max` and
/// `memory.high` against `memory.current`, and of the older one (v1) `memory.limit_in_bytes` and
/// the `hierarchical_memory_limit` of `memory.stat` against `memory.usage_in_bytes`. A group that
/// cannot be seen, as those outside of a container, is passed over.
/// Source: the kernel's Documentation/admin-guide/cgroup-v2.rst and cgroup-v1/memory.rst.
/// @param root        where the hierarchies are mounted
/// @param membership  the process's groups, as the lines of /proc/self/cgroup name them
/// @return the largest number where nothing limits the process
std::uint64_t controlGroupAvailableBytes(const std::filesystem::path& root,
                                         const std::string& membership);

/// Of this process.
std::uint64_t controlGroupAvailableBytes();

}  // namespace gnomon
