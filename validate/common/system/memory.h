#pragma once

#include <cstddef>
#include <cstdint>
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

}  // namespace gnomon
