#pragma once

#include <string>

namespace CLI {
class App;
}

namespace gnomon::cli {

/// The manual page gnomon(1) in the language of man(7), UTF-8: every command with its options and
/// examples, as `--help` has them.
std::string manualPage(const CLI::App& app, const std::string& version);

}  // namespace gnomon::cli
