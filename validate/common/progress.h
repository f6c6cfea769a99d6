#pragma once

#include <functional>

namespace gnomon {

/// Receives the share of a long computation that is done, from 0 to 1. It may be called from any
/// thread, but never from two at once. An empty function means that nobody is watching.
using Progress = std::function<void(double share)>;

}  // namespace gnomon
