#pragma once

#include <memory>
#include <optional>
#include <string>

#include "cache/cache.h"
#include "common/error.h"

namespace gnomon::cli {

/// The user's cache, or one that is off: where it is not wanted, or there is no place for it.
std::unique_ptr<cache::Cache> openCache(bool isOff);

/// What `gnomon cache` was asked for.
struct CacheRequest {
  bool clear = false;
  std::optional<std::string> limit;  ///< as parseBytes
};

/// Clears the cache or sets its bound, if asked to, and prints where it is and what it holds.
/// @throws UsageError for a bound that is no number of bytes; InputError where it cannot be kept,
/// or
///   there is no place for a cache
ExitStatus showCache(const CacheRequest& request);

}  // namespace gnomon::cli
