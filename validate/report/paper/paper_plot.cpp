#include "report/paper/paper_plot.h"

#include <fmt/core.h>

#include <algorithm>

#include "report/text/text_width.h"

namespace gnomon::report {

std::vector<std::string> paperPdfs(const std::vector<LinePlot>& plots, PaperWidth width,
                                   double fontSize) {
  constexpr double inch = 25.4;  // millimetres
  const double points = millimetresOf(width) * pointsOfMillimetre;
  std::vector<std::string> scripts;
  for (const LinePlot& plot : plots) {
    std::size_t longest = 24;  // "uncertainty of the truth"
    for (const PlotCurve& curve : plot.curves) {
      longest = std::max(longest, displayWidth(shortLegend(curve.label)));
    }
    // A character is half as wide as the font is high; the symbol takes as much as six.
    const double room = points / (0.5 * fontSize * static_cast<double>(longest + 6));
    const auto columns = static_cast<std::size_t>(std::clamp(room, 1.0, 4.0));
    const std::size_t rows = (plot.curves.size() + columns) / columns;
    const double height = (width == PaperWidth::column ? 70 : 84) +
                          1.3 * fontSize * static_cast<double>(rows) / pointsOfMillimetre;
    // At 0.8 its points are points. Small letters of the usual plain fonts are higher than a
    // paper's: at 0.68 they look alike.
    scripts.push_back(
        fmt::format("set encoding utf8\nset terminal pdfcairo size {:.3f}in,{:.3f}in noenhanced "
                    "font 'sans-serif,{:g}' fontscale 0.68 linewidth 0.5\n{}",
                    millimetresOf(width) / inch, height / inch, fontSize,
                    paperCommands(plot, fontSize, columns)));
  }
  return undatedPdfs(scripts);
}

}  // namespace gnomon::report
