#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace gnomon::app {

/// The steps by which a person changed a value, to go back and forth between them. A drag, or
/// several presses of a key in a row, are one step: a step ends when the value has rested.
template <typename Value>
class History {
 public:
  static constexpr double restSeconds = 0.5;
  static constexpr std::size_t mostSteps = 1000;  ///< the oldest are forgotten

  explicit History(Value start) : present_(std::move(start)), seen_(present_) {}

  /// Tells it the value as it is; to be called often.
  /// @param seconds  of a clock that never goes back
  /// @param isHeld   the value is still being changed: a button is down, a film is played
  void observe(const Value& now, double seconds, bool isHeld) {
    // What has rested until now is a step, however long ago this was told last.
    if (!wasHeld_ && seconds - changedAt_ >= restSeconds) endStep();
    if (isHeld || !(now == seen_)) changedAt_ = seconds;
    seen_ = now;
    wasHeld_ = isHeld;
  }

  /// Back by one step, or forth again.
  /// @return the value to take; the present one where there is no such step
  const Value& undo() {
    endStep();
    return move(past_, future_);
  }
  const Value& redo() {
    endStep();
    return move(future_, past_);
  }
  [[nodiscard]] bool canUndo() const { return !past_.empty() || !(seen_ == present_); }
  [[nodiscard]] bool canRedo() const { return !future_.empty() && seen_ == present_; }

 private:
  /// A new step leaves nothing to go forth to.
  void endStep() {
    if (seen_ == present_) return;
    if (past_.size() == mostSteps) past_.erase(past_.begin());
    past_.push_back(std::exchange(present_, seen_));
    future_.clear();
  }
  const Value& move(std::vector<Value>& from, std::vector<Value>& to) {
    if (!from.empty()) {
      to.push_back(std::exchange(present_, std::move(from.back())));
      from.pop_back();
      seen_ = present_;
    }
    return present_;
  }

  std::vector<Value> past_, future_;  ///< the nearest last
  Value present_;                     ///< at the end of the last step
  Value seen_;                        ///< as last told
  double changedAt_ = 0;
  bool wasHeld_ = false;
};

}  // namespace gnomon::app
