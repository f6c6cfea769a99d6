#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "study/run/scene/stage_clock.h"

namespace gnomon::study {

/// Pictures that wait to be encoded, so that all of a panel are at the same time: one alone leaves
/// threads idle.
class EncodingQueue {
 public:
  using Work = std::function<void()>;

  /// @param clock  of the stage "writing"; outlives the queue
  explicit EncodingQueue(StageClock& clock) : clock_(clock) {}

  /// @param encodings  called at any time until `finish` returns, each on any thread: what they
  ///                   refer to stays till then
  /// @param then       called after them on the thread that owns the queue, in the order of `add`
  /// @param heldBytes  that they hold while they wait: those of too many do not
  void add(std::vector<Work> encodings, Work then, std::size_t heldBytes = 0);
  /// Does all that waits.
  void finish();

 private:
  StageClock& clock_;
  std::vector<Work> encodings_, after_;
  std::size_t heldBytes_ = 0;
};

}  // namespace gnomon::study
