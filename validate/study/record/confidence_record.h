#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "compare/confidence_interval.h"

namespace gnomon::study {

/// The light of a record that speaks of all lights of its study together.
constexpr std::string_view allLights = "all";

/// A method's error rate with its confidence interval: over all samples of a view, under one light,
/// or the mean over all lights ("all"). Every view has the row "all"; a study with several lights
/// has one for each of them as well.
struct ConfidenceRecord {
  std::string method;  ///< a MethodRecord's label
  std::string view;
  std::string light;                          ///< its name, or "all"
  double rate = 0;                            ///< error rate, 0 to 1
  std::optional<compare::Interval> interval;  ///< 95 %; none where the view has too few blocks
  std::string reason;                         ///< why there is none; empty if there is one
  std::size_t blocks = 0;                     ///< that hold a sample
  int blockSide = 0;                          ///< samples
};

/// How the first of two methods compares with the second.
enum class DifferenceVerdict {
  better,
  worse,
  equal,               ///< both give the same answers, to the sample
  notDistinguishable,  ///< by the interval of the difference, or within the truth's uncertainty
  noInterval,          ///< too little is known to say any of these
};

/// Two methods of one view, paired block by block: under one light, or all lights together ("all").
/// Every view has the row "all"; a study with several lights has one for each of them as well. The
/// intervals are not corrected for the number of pairs: of twenty pairs that do not differ, one may
/// seem to.
struct DifferenceRecord {
  std::string view;
  std::string light;      ///< its name, or "all": the mean over the lights
  std::string first;      ///< a MethodRecord's label
  std::string second;     ///< likewise, later in the study
  double difference = 0;  ///< error rate of the first less that of the second: below 0 it is better
  std::optional<compare::Interval> interval;  ///< 95 %, of the difference
  std::string reason;                         ///< why there is none; empty if there is one
  double uncertainty = 0;                     ///< of the truth in this view, mean over these lights
  /// By `distinguish`.
  DifferenceVerdict verdict = DifferenceVerdict::noInterval;
};

}  // namespace gnomon::study
