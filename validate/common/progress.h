#pragma once

#include <functional>

namespace gnomon {

/// Receives the share of a long computation that is done, from 0 to 1. It may be called from any
/// thread, but never from two at once. An empty function means that nobody is watching.
///
/// It may throw: that cancels the computation. What has begun is finished, no more than a row or a
/// face on every thread; the rest is left undone, and the exception leaves the call to the
/// computation.
using Progress = std::function<void(double share)>;

}  // namespace gnomon
