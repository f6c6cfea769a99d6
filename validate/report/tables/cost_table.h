#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "report/tables/table.h"
#include "study/record/record.h"

namespace gnomon::report {

/// The method that frame times are set against: the flat horizon map.
constexpr std::string_view costReference = "max-forsyth";

/// The cost of the method with that label; none where it has none.
const study::CostRecord* costOf(const study::StudyRecord& record, std::string_view label);

/// What a method reads: its tables and the height map, bytes.
std::uint64_t memoryBytes(const study::CostRecord& cost);

/// A method's frame time over that of the method named `costReference` in the same run (of several,
/// the one with that label, or else the first). None where either was not timed.
/// @throws InternalError for a frame time that is not finite
std::optional<double> frameRatio(const study::StudyRecord& record, const study::CostRecord& cost);

/// Memory, triangles, passes and frame time of each method, and that time's ratio to max-forsyth's.
Table costTable(const study::StudyRecord& record);

/// Which frame times an earlier run measured, and when, as a sentence. Empty if this run measured
/// all.
std::string keptFrames(const study::StudyRecord& record);

/// The run's frame rates beside the paper's statement about them (Onoue, Max & Nishita 2004,
/// section 4), as one paragraph of text that names the renderer. Empty unless the run timed all of
/// max-forsyth, onoue-2004 and shadow-volume.
std::string publishedRates(const study::StudyRecord& record);

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
