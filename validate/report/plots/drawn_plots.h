#pragma once

#include <functional>
#include <string>
#include <vector>

#include "report/plots/plot_sheet.h"

namespace gnomon::cache {
class Cache;
}

namespace gnomon::report {

/// A plot as a report embeds it.
struct DrawnPlot {
  PlotSheet sheet;  ///< for PlotPlace::page
  std::string svg;
  PlotSheet narrow = {};  ///< for PlotPlace::phone; none where that is as wide: it scrolls sideways
  std::string narrowSvg = {};
};

/// All plots of a report, drawn.
struct DrawnPlots {
  struct File {
    std::string name;  ///< "plots/NAME.svg"
    std::string bytes;
  };
  std::vector<DrawnPlot> page;
  std::vector<File> paper;  ///< each as SVG and as PDF
};

/// Draws the plots of a report for every place, several in one process of gnuplot.
/// @param sheetsFor  the plots for a place, in the same order for each
/// @param cache      gives what it has and keeps what was drawn; may be null
/// @throws InternalError as svgsOf
DrawnPlots drawPlots(const std::function<std::vector<PlotSheet>(PlotPlace)>& sheetsFor,
                     cache::Cache* cache);

}  // namespace gnomon::report
