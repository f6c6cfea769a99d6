#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::study {

/// On a claim. `equal` and `noInterval` as in DifferenceVerdict.
enum class Verdict { held, failed, equal, notDistinguishable, noInterval, notEvaluated };

/// The least, the greatest and the quartiles between them.
struct Quartiles {
  double least = 0;
  double first = 0;
  double median = 0;
  double third = 0;
  double most = 0;
};

/// Linear between the two nearest of the sorted values; none of no value.
std::optional<Quartiles> quartilesOf(std::vector<double> values);

/// The results of a claim over the cases of its study. A case is one view under one light.
struct ClaimSpread {
  std::size_t cases = 0;   ///< in which the claim's metric is defined
  std::size_t held = 0;    ///< it holds there, distinguishably
  std::size_t failed = 0;  ///< the opposite holds there, distinguishably
  std::size_t views = 1;   ///< that the cases are from
  /// What the quartiles are of: "ratio", the claim's `less` over its `than` in each case where that
  /// is above 0; or "value", of its `method`.
  std::string quantity;
  std::optional<Quartiles> quartiles;  ///< none where no case has the quantity
  bool hasIntervals = false;  ///< false: judged by the truth's uncertainty alone, see judgeClaims
  /// Of the mean over all cases, by its own interval; none without intervals, or of one case.
  std::optional<Verdict> together = std::nullopt;
  std::size_t equal = 0;            ///< cases in which both methods give the same answers
  std::size_t withoutInterval = 0;  ///< cases in which too little is known

  /// The cases with none of these.
  [[nodiscard]] std::size_t notDistinguishable() const {
    return cases - held - failed - equal - withoutInterval;
  }
};

/// "held", "failed", "equal", "not distinguishable", "no interval" or "not evaluated": the same in
/// every kind of report.
std::string_view verdictName(Verdict verdict);

/// "holds for all lights together; holds under 25 of 27 lights, fails under 1, equal under 1, no
/// interval under 1; ratio 0.48 (0.30 to 0.90, quartiles 0.41 and 0.60)": what is true of no case
/// is left out, save for "fails"; the median, then the least and the greatest where there are
/// several cases, and the quartiles from four cases on. Over several views "for all cases together;
/// holds in 25 of 54".
std::string spreadText(const ClaimSpread& spread);

}  // namespace gnomon::study
