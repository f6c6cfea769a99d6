#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace gnomon {

/// The name that a mistyped one was probably meant to be: the nearest by the number of letters that
/// are missing, too many, wrong, or swapped with their neighbour (Damerau 1964), in at most a
/// third of its letters; or else the shortest that begins with the typed one's three letters or
/// more.
std::optional<std::string> nearestName(std::string_view typed,
                                       const std::set<std::string, std::less<>>& names);

}  // namespace gnomon
