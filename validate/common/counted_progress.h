#pragma once

#include <cstddef>
#include <mutex>

#include "common/progress.h"

namespace gnomon {

/// Tells a Progress how many of a known number of parts are done, from any thread.
class CountedProgress {
 public:
  /// @param progress  outlives this
  /// @param parts     in all, at least one
  CountedProgress(const Progress& progress, std::size_t parts)
      : progress_(progress), parts_(parts) {}

  /// One part more is done. Throws what the Progress throws.
  void advance() {
    if (!progress_) return;
    const std::scoped_lock lock(reporting_);
    progress_(static_cast<double>(++done_) / static_cast<double>(parts_));
  }

 private:
  const Progress& progress_;
  std::size_t parts_;
  std::size_t done_ = 0;
  std::mutex reporting_;
};

}  // namespace gnomon
