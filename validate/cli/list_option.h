#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace gnomon::cli {

/// Adds an option that may be repeated and takes one value each time.
inline CLI::Option* addList(CLI::App& command, const std::string& name,
                            std::vector<std::string>& values, const std::string& about,
                            const char* type) {
  return command.add_option(name, values, about)
      ->type_name(type)
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

}  // namespace gnomon::cli
