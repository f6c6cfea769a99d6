#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::study {

enum class Verdict { held, failed, notDistinguishable, notEvaluated };

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

  /// Neither held nor failed.
  [[nodiscard]] std::size_t notDistinguishable() const { return cases - held - failed; }
};

/// "holds for all lights together; holds under 25 of 27 lights, fails under 1; ratio 0.48 (0.30 to
/// 0.90, quartiles 0.41 and 0.60)": the median, then the least and the greatest where there are
/// several cases, and the quartiles from four cases on. Over several views "for all cases together;
/// holds in 25 of 54".
std::string spreadText(const ClaimSpread& spread);

}  // namespace gnomon::study
