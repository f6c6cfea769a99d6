#pragma once

#include <string>
#include <vector>

#include "report/tables/table.h"
#include "study/record/record.h"

namespace gnomon::report {

/// One method entry's memory and mean error.
struct FrontierPoint {
  std::string label;
  std::string name;        ///< the method's own: entries of one name are one series
  double bytes = 0;        ///< its tables and the height map, where it reads it
  double errorRate = 0;    ///< mean over lights and views, share of the samples
  bool efficient = false;  ///< no other entry has as little memory and as small an error
};

/// The entries that read tables or the height map and answer in every case (rankOverStudies), by
/// memory, then error. Empty unless some method
/// stands in the study with two different memories: only then there is something to trade.
std::vector<FrontierPoint> frontier(const study::StudyRecord& record);

/// For programs: method (its label), shader (its name), bytes, error_rate, efficient.
Table frontierTable(const std::vector<FrontierPoint>& points);

}  // namespace gnomon::report
