#pragma once

#include <string>

namespace CLI {
class App;
}

namespace gnomon::cli {

/// A script for bash that completes commands, and behind one its options; files elsewhere.
std::string bashCompletion(const CLI::App& app);

}  // namespace gnomon::cli
