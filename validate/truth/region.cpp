#include "truth/region.h"

#include <fmt/core.h>

#include "common/error.h"

namespace gnomon::truth {

std::string_view regionName(Region region) {
  switch (region) {
    case Region::none:
      return "none";
    case Region::lit:
      return "lit";
    case Region::attached:
      return "attached";
    case Region::cast:
      return "cast";
    case Region::distant:
      return "distant";
    case Region::global:
      return "global";
    case Region::beyondTerminator:
      return "beyond-terminator";
  }
  throw InternalError("a region without a name");
}

std::vector<std::string> partRegions(std::span<const std::string> partNames) {
  std::vector<std::string> names(partNames.begin(), partNames.end());
  for (const std::string& receiver : partNames) {
    for (const std::string& caster : partNames) {
      names.push_back(fmt::format("{} shaded by {}", receiver, caster));
    }
  }
  return names;
}

std::vector<std::string> allRegions(std::span<const std::string> partNames) {
  const std::vector<std::string> ofParts = partRegions(partNames);
  std::vector<std::string> names;
  names.reserve(reportedRegions.size() + 1 + ofParts.size());
  for (const Region region : reportedRegions) names.emplace_back(regionName(region));
  names.emplace_back(seamRegion);
  names.insert(names.end(), ofParts.begin(), ofParts.end());
  return names;
}

}  // namespace gnomon::truth
