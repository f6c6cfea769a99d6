#include "report/plots/panel_grid.h"

#include <fmt/core.h>

#include <algorithm>

#include "report/plots/gnuplot.h"
#include "report/plots/plot_style.h"

namespace gnomon::report {
namespace {

constexpr std::size_t mostColumns = 3;

/// Room for the longest label with its symbol, as a share of the page.
double legendShare(const std::vector<std::string>& legends, int width) {
  if (legends.empty()) return 0;
  constexpr double symbol = 50;    // pixels
  constexpr double character = 8;  // likewise: wider than those of most fonts of 14 pixels
  std::size_t longest = 0;
  for (const std::string& legend : legends) {
    longest = std::max(longest, std::min(longestLegend, displayWidth(legend)));
  }
  return (symbol + character * static_cast<double>(longest)) / width;
}

}  // namespace

PanelGrid::PanelGrid(std::size_t panels, const std::vector<std::string>& legends, PlotPlace place)
    : isNarrow_(place == PlotPlace::phone),
      panels_(std::max<std::size_t>(1, panels)),
      columns_(isNarrow_ ? 1 : std::min(mostColumns, panels_)),
      rows_((panels_ + columns_ - 1) / columns_),
      right_(0.985 - legendShare(legends, width())) {}

std::string PanelGrid::opening(const std::string& axis) const {
  return fmt::format(
      "set multiplot\n"
      "set border 3 lc rgb axis\n"
      "set tics nomirror out textcolor rgb ink font ',9'\n"
      "set grid ytics lc rgb grid lw 1 dt 1\n"
      "set title offset 0,-0.6 font ',12' textcolor rgb ink\n"
      "set key textcolor rgb ink\n"
      "set label 99 {} at screen {:.4f}, screen {:.4f} center textcolor rgb ink\n"
      "set key at screen {:.4f}, screen {:.4f} left top Left reverse samplen 2 spacing 1.1 "
      "maxcols 1\n",
      gnuplotText(axis), (50.0 / width() + right_) / 2, 14.0 / height(), right_ + 0.012,
      1 - 14.0 / height());
}

std::string PanelGrid::panel(std::size_t index) const {
  const std::size_t column = index % columns_;
  const std::size_t row = index / columns_;
  const double cell = (right_ - 0.005) / static_cast<double>(columns_);
  const double left = 0.005 + cell * static_cast<double>(column);
  const double top = 1 - static_cast<double>(row * panelHeight) / height();
  const auto pixels = [&](double count) { return count / height(); };
  std::string text = fmt::format(
      "set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\n"
      "set tmargin at screen {:.4f}\nset bmargin at screen {:.4f}\n",
      left + 48.0 / width(), left + cell - 8.0 / width(), top - pixels(28),
      top - pixels(panelHeight - 34));
  if (index == 1) text += "unset key\nunset label 99\n";
  return text;
}

}  // namespace gnomon::report
