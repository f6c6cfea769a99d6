#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::truth {

/// Why a sample is lit or shadowed. Every sample of a view is in exactly one of these regions,
/// where several hold in the first of: beyondTerminator, attached, global, distant, cast. The
/// region `seam` overlaps them (see surface_paths.h).
enum class Region : std::uint8_t {
  none,              ///< no sample, or no frame there
  lit,               ///< the light reaches it
  attached,          ///< its own facet is turned from the light
  cast,              ///< shadowed by an occluder within the tables' radius
  distant,           ///< shadowed only by an occluder beyond that radius
  beyondTerminator,  ///< the undisplaced surface is turned from the light, n·L ≤ 0: lit or not
  global,            ///< shadowed from where the path over the surface does not lead: another limb,
                     ///< the body's far side, another body; see surface_paths.h
};

/// As reports and thresholds spell it: "lit", "attached", "cast", "distant", "global",
/// "beyond-terminator".
std::string_view regionName(Region region);

/// The regions that results are reported for, in order.
inline constexpr std::array reportedRegions = {Region::lit,    Region::attached,
                                               Region::cast,   Region::distant,
                                               Region::global, Region::beyondTerminator};

/// The name, in reports and thresholds, of the region of samples whose path crosses a seam (see
/// surface_paths.h). It overlaps the regions of `Region`: such a sample is also lit or shadowed.
constexpr std::string_view seamRegion = "seam";

/// The regions of a surface with parts, which overlap those of `Region` too. Receivers first: a
/// part's name holds the samples on it; then for each receiver every caster: "ground shaded by
/// spot" holds those in a cast shadow whose first occluder is on the other part, or on the same.
std::vector<std::string> partRegions(std::span<const std::string> partNames);

/// The names of all regions but the whole, in the order of reports: reportedRegions, seamRegion,
/// partRegions.
std::vector<std::string> allRegions(std::span<const std::string> partNames);

/// Whether all its samples are shadowed, and by something else than their own facet.
constexpr bool isCastShadow(Region region) {
  return region == Region::cast || region == Region::distant || region == Region::global;
}

/// Whether all its samples are shadowed.
constexpr bool isDark(Region region) {
  return region == Region::attached || isCastShadow(region);
}

}  // namespace gnomon::truth
