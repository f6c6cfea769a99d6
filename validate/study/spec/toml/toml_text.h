#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>
#include <vector>

namespace gnomon::study {

/// A value in line, as a TOML file has it. Numbers have the fewest digits that read back to the
/// bit.
std::string tomlValueText(const toml::node& node);

/// A table as the text of a TOML file: its tables as `[key]`, its lists of tables as `[[key]]`, all
/// below them in line. Numbers have the fewest digits that read back to the bit (toml++ itself
/// writes 0.1 as 0.10000000000000001, and tables in alphabetical order).
/// @param order  keys that come first, in this order
/// @throws InputError where the text would not read back as the same table: TOML can hold no text
///   that is not UTF-8
std::string tomlText(const toml::table& table, const std::vector<std::string_view>& order = {});

}  // namespace gnomon::study
