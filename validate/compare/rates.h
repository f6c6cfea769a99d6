#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compare/counts.h"

namespace gnomon::compare {

/// One metric. Undefined values have no number but a reason; they are never reported as 0 or 1.
struct Metric {
  std::string_view name;        ///< as reports and thresholds spell it
  std::optional<double> value;  ///< dimensionless; rates 0 to 1, mcc -1 to 1
  std::string_view reason;      ///< why there is no value; empty if there is one
};

/// All rates of one comparison, in this order:
///   error_rate    (FP + FN) / all
///   false_shadow  FP / all
///   false_light   FN / all                  (the two add up to error_rate)
///   fpr           FP / (FP + TN)            undefined where the truth has no lit sample
///   fnr           FN / (FN + TP)            undefined where the truth has no shadow
///   ber           (fpr + fnr) / 2           balanced error rate
///   iou           TP / (TP + FP + FN)       of the shadows; undefined where neither has any
///   f1            2 TP / (2 TP + FP + FN)
///   mcc           (TP TN - FP FN) / √((TP+FP)(TP+FN)(TN+FP)(TN+FN))  Matthews correlation
///   prevalence    (TP + FN) / all           share of shadow in the truth
/// f1 is undefined where iou is, and f1 = 2 iou / (1 + iou); ber where fpr or fnr is; mcc where
/// either mask is all lit or all shadowed. Nothing is defined without samples or without area.
/// @throws InternalError if a cell is negative or not finite
std::vector<Metric> rates(const Counts& counts);

/// One metric by name.
/// @throws InternalError for a name that `rates` does not have
Metric rate(const Counts& counts, std::string_view name);

/// The least value that a metric can have, by its name: -1 for mcc, 0 for all others, of other
/// lists too. The largest of a rate is 1.
double leastRate(std::string_view name);

/// The metric of a name.
/// @throws InternalError where it is not among them
const Metric& metricNamed(std::span<const Metric> metrics, std::string_view name);

/// The names above, in order.
const std::vector<std::string_view>& rateNames();

}  // namespace gnomon::compare
