#include "report/plots/plot_style.h"

#include <fmt/core.h>

#include <cmath>

#include "report/text/number_text.h"

namespace gnomon::report {

std::string plotMargins(const PlotMargins& margins, int width, int height) {
  const auto share = [](int pixels, int all) {
    return static_cast<double>(pixels) / static_cast<double>(all);
  };
  return fmt::format(
      "set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\n"
      "set tmargin at screen {:.4f}\nset bmargin at screen {:.4f}\n",
      share(margins.left, width), 1 - share(margins.right, width), 1 - share(margins.top, height),
      share(margins.bottom, height));
}

bool isGeometric(const std::vector<double>& places) {
  constexpr std::size_t fewest = 4;
  if (places.size() < fewest || !(places.front() > 0)) return false;
  const double ratio = places[1] / places[0];
  for (std::size_t i = 1; i < places.size(); ++i) {
    if (std::abs(places[i] / places[i - 1] / ratio - 1) > 0.01) return false;
  }
  return ratio > 1;
}

std::string plotBand(const std::string& data, bool hasTitle) {
  return data + " using 1:2 with filledcurves y1=0 fc rgb band " +
         (hasTitle ? fmt::format("title '{}'", bandLegend) : "notitle");
}

std::string plotBandBelow(double value) {
  return fmt::format(
      "set object 1 rectangle from graph 0, graph 0 to graph 1, first {} fc rgb band "
      "fs solid noborder behind\n",
      exactText(value));
}

std::string plotBandEntry() {
  return fmt::format(", \\\n  keyentry with boxes fs solid fc rgb band title '{}'", bandLegend);
}

LegendItem bandItem() {
  return {.text = bandLegend, .variable = "band"};
}

void ValuePoints::add(PlotSheet& sheet, double x, double y, std::string text) {
  curves_.back() += fmt::format("{} {} \"{}\"\n", exactText(x), exactText(y), sheet.values.size());
  sheet.values.push_back(std::move(text));
}

void ValuePoints::endCurve() {
  if (!curves_.back().empty()) curves_.emplace_back();
}

bool ValuePoints::areDrawn(const PlotSheet& sheet) const {
  return sheet.place != PlotPlace::paper && !curves_.front().empty();
}

std::string ValuePoints::data(const PlotSheet& sheet) const {
  if (!areDrawn(sheet)) return {};
  std::string text;
  for (std::size_t i = 0; i < curves_.size(); ++i) {
    if (!curves_[i].empty()) text += plotData(fmt::format("{}{}", name_, i), curves_[i]);
  }
  return text;
}

std::string ValuePoints::plot(const PlotSheet& sheet) const {
  if (!areDrawn(sheet)) return {};
  std::string text;
  for (std::size_t i = 0; i < curves_.size(); ++i) {
    if (curves_[i].empty()) continue;
    text += fmt::format(
        ", \\\n  {}{} using 1:2:3 with labels hypertext point pt 6 ps 1.3 lw 2 lc rgb ink notitle",
        name_, i);
  }
  return text;
}

}  // namespace gnomon::report
