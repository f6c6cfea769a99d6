#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "study/record/confidence_record.h"

namespace gnomon::study {

/// A part of an error rate, as a share of all samples. Negative where correcting a cause made the
/// error larger: two errors of a method may cancel.
struct BudgetShare {
  double value = 0;
  std::optional<compare::Interval> interval;  ///< 95 %; none where the view is too small to tell
  std::string reason;                         ///< why there is none; empty if there is one
  /// How the share compares with none, by `distinguish`.
  DifferenceVerdict verdict = DifferenceVerdict::noInterval;
};

/// By how much a method's error falls when one cause is corrected.
struct BudgetCause {
  std::string name;
  std::string change;    ///< what was put in its place
  BudgetShare forward;   ///< after the causes before it
  BudgetShare backward;  ///< after the causes behind it
};

/// The error rates of a method with some causes corrected.
struct BudgetState {
  double errorRate = 0;
  double falseShadow = 0;
  double falseLight = 0;
};

/// A part of the error that remains when all causes are corrected.
struct BudgetRest {
  std::string name;  ///< as `budgetRestNames`
  BudgetShare share;
};

/// One method's error and where it comes from: `total` = Σ shares of either order + Σ `rest`.
struct BudgetRecord {
  std::string method;  ///< a MethodRecord's label
  std::string view;
  std::string light;       ///< its name, or "all": the mean over the study's lights
  double uncertainty = 0;  ///< of the truth in this view, mean over these lights
  std::size_t blocks = 0;  ///< of the view that hold a sample
  BudgetShare total;       ///< the method's error rate
  std::vector<BudgetCause> causes;
  std::vector<BudgetRest> rest;       ///< what remains
  std::vector<BudgetState> forward;   ///< one more than there are causes
  std::vector<BudgetState> backward;  ///< likewise
};

}  // namespace gnomon::study
