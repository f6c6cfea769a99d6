#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::cli {

/// The words of a command line behind the program's name, as they were typed.
using Arguments = std::vector<std::string>;

/// "gnomon WORD…", each word as a shell reads it back.
std::string commandText(std::span<const std::string> arguments);

/// Without an option that takes one value: `--name VALUE` or `--name=VALUE`.
Arguments withoutOption(const Arguments& arguments, std::string_view name);

/// With another folder of results: in the place of `--out` where it is there, else at the end,
/// and without the option where it is the folder that a run without it writes to.
Arguments withOut(const Arguments& arguments, const std::string& out);

}  // namespace gnomon::cli
