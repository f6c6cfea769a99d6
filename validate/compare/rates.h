#pragma once

#include <vector>

#include "compare/counts.h"
#include "compare/metric.h"

namespace gnomon::compare {

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

/// One of them.
/// @throws InternalError for a metric of another kind
Metric rate(const Counts& counts, MetricId id);

}  // namespace gnomon::compare
