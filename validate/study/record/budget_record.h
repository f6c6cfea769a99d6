#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "compare/confidence_interval.h"

namespace gnomon {

/// A part of an error rate, as a share of all samples. Below 0 where undoing a cause made matters
/// worse: two wrongs of a method may cancel.
struct BudgetShare {
  double value = 0;
  std::optional<Interval> interval;  ///< 95 %; none where the view is too small to tell
  std::string reason;                ///< why there is none; empty if there is one
  /// From none, by `distinguish`.
  bool distinguishable = false;
};

/// What one cause takes of a method's error when it is undone.
struct BudgetCause {
  std::string name;
  std::string change;    ///< what was put in its place
  BudgetShare forward;   ///< after the causes before it
  BudgetShare backward;  ///< after the causes behind it
};

/// A method with some of its causes undone.
struct BudgetState {
  double errorRate = 0;
  double falseShadow = 0;
  double falseLight = 0;
};

/// One method's error and where it comes from: `total` = Σ shares of either order + `distant` +
/// `other`.
struct BudgetRecord {
  std::string method;  ///< a MethodRecord's label
  std::string view;
  std::string light;       ///< its name, or "all": the mean over the study's lights
  double uncertainty = 0;  ///< of the truth in this view, mean over these lights
  std::size_t blocks = 0;  ///< of the view that hold a sample
  BudgetShare total;       ///< the method's error rate
  std::vector<BudgetCause> causes;
  BudgetShare distant;  ///< left, in the region `distant`: only global geometry can tell
  BudgetShare other;    ///< left elsewhere
  std::vector<BudgetState> forward;   ///< one more than there are causes
  std::vector<BudgetState> backward;  ///< likewise
};

}  // namespace gnomon
