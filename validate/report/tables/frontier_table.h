#pragma once

#include <string>
#include <vector>

#include "report/tables/table.h"
#include "study/record/record.h"

namespace gnomon::report {

/// What an answer costs.
enum class Price {
  memory,     ///< bytes of the tables, and of the height map where the method reads it
  frameTime,  ///< of a frame with all its passes, milliseconds
};

/// One method entry's price and mean error.
struct FrontierPoint {
  std::string label;
  std::string name;        ///< the method's own: entries of one name are one series
  double price = 0;        ///< bytes or milliseconds
  double errorRate = 0;    ///< mean over lights and views, share of the samples
  bool efficient = false;  ///< no other entry has as low a price and as small an error
};

/// The entries that have a price and answer in every case (rankOverStudies), by price, then error.
/// Empty unless some method stands in the study at two different prices: only then there is
/// something to trade.
std::vector<FrontierPoint> frontier(const study::StudyRecord& record, Price price);

/// Points by memory, for programs: method (its label), shader (its name), bytes, error_rate,
/// efficient.
Table frontierTable(const std::vector<FrontierPoint>& points);

}  // namespace gnomon::report
