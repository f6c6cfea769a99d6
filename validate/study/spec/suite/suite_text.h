#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>
#include <vector>

namespace gnomon::study {

/// The sections of a study as the text of a TOML file: `[key]`, or `[[key]]` for each table of a
/// list, in the given order; below them `key = value`, in alphabetical order. Every byte is made
/// here, and none by a library, whose next version may write another form of the same values:
/// strings in double quotes, numbers with the fewest digits that read back to the bit.
/// @param order  all sections; those that are not there are left out
std::string suiteText(const toml::table& study, const std::vector<std::string_view>& order);

}  // namespace gnomon::study
