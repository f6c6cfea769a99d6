#include "cli/commands/cache_command.h"

#include <fmt/core.h>

#include <filesystem>

#include "cache/cache_folder.h"
#include "cli/output.h"
#include "common/system/memory.h"
#include "report/text/number_text.h"
#include "study/run/scene/run_keys.h"

namespace gnomon::cli {

std::unique_ptr<cache::Cache> openCache(bool isOff) {
  const std::optional<std::filesystem::path> folder = cache::standardCacheFolder();
  if (isOff || !folder) return std::make_unique<cache::Cache>();
  return std::make_unique<cache::Cache>(
      *folder, cache::limitOf(*folder),
      cache::CacheOwner{study::programKey(), study::processorKey()},
      [](const std::string& why) { printWarning(why); });
}

ExitStatus showCache(const CacheRequest& request) {
  const std::optional<std::filesystem::path> folder = cache::standardCacheFolder();
  if (!folder) {
    throw InputError("no place for a cache: GNOMON_CACHE, XDG_CACHE_HOME or HOME expected");
  }
  if (request.limit) cache::setLimit(*folder, cache::parseBytes(*request.limit));
  const std::uint64_t limit = cache::limitOf(*folder);
  const cache::CacheUsage usage = request.clear || request.limit
                                      ? cache::trimTo(*folder, request.clear ? 0 : limit)
                                      : cache::usageOf(*folder);
  printLine(fmt::format(
      "{}: {} entries, {} of at most {}", folder->string(), report::groupedText(usage.entries),
      formatBytes(static_cast<double>(usage.bytes)), formatBytes(static_cast<double>(limit))));
  return ExitStatus::pass;
}

}  // namespace gnomon::cli
