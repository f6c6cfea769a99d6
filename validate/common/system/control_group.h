#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace gnomon {

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
