#pragma once

#include "cli/commands/view_request.h"

namespace CLI {
class App;
}

namespace gnomon::cli {

/// Adds `gnomon view` and its options; they fill `request`.
CLI::App* addViewCommand(CLI::App& app, ViewRequest& request);

}  // namespace gnomon::cli
