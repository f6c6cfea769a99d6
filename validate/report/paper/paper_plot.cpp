#include "report/paper/paper_plot.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "report/text/latex_text.h"

namespace gnomon::report {
namespace {

/// The settings of a sheet's first plot, and its command.
struct FirstPlot {
  std::string settings, plot;
};

FirstPlot firstPlotOf(const std::string& commands) {
  FirstPlot first;
  std::istringstream lines(commands);
  bool isPlot = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("set multiplot")) continue;
    isPlot = isPlot || line.starts_with("plot ");
    (isPlot ? first.plot : first.settings) += line + "\n";
    if (isPlot && !line.ends_with('\\')) break;
  }
  return first;
}

constexpr double legendLine = 1.3;  ///< of the legend, in units of the font's size

/// How many texts a legend has, and in how many rows: in as many columns as fit.
struct Legend {
  std::size_t texts = 0, rows = 0;
  double left = 0;  ///< where it begins, as a share of the figure's width
};

/// Cuts what the plot command writes into its legend where it is wider than the figure.
/// @param room  the figure's width, in units of the font's size
Legend fitLegend(std::string& plot, double room) {
  constexpr std::string_view word = " title '";
  constexpr double symbol = 6;  // with the gaps on its sides, likewise
  Legend legend;
  double longest = 0;
  for (std::size_t at = 0; (at = plot.find(word, at)) != std::string::npos;) {
    at += word.size();
    const std::size_t length = plot.find('\'', at) - at;
    const std::string text = cutText(plot.substr(at, length), room - symbol);
    plot.replace(at, length, text);
    longest = std::max(longest, latexWidth(text));
    ++legend.texts;
  }
  const auto columns = static_cast<std::size_t>(std::clamp(room / (longest + symbol), 1.0, 4.0));
  legend.rows = (legend.texts + columns - 1) / columns;
  const double width = static_cast<double>(std::min(columns, legend.texts)) * (longest + symbol);
  legend.left = std::max(0.0, (room - width) / (2 * room));
  return legend;
}

/// What the page has said of margins, fonts and the legend, anew.
/// @param height  of the figure, points
/// @param page    the page's settings
std::string paperSettings(const std::string& page, const Legend& legend, double fontSize,
                          double height) {
  std::string settings = "set lmargin\nset rmargin\nset tmargin\nunset title\n";
  for (const char* axis : {"xtics", "x2tics", "ytics"}) {
    // A font alone would give a plot an upper axis.
    const bool isUpper = axis == std::string_view("x2tics");
    if (isUpper && page.find("set x2tics") == std::string::npos) continue;
    settings += fmt::format("set {} font ',{:g}'\n", axis, fontSize);
  }
  for (const char* label : {"xlabel", "x2label", "ylabel"}) {
    settings += fmt::format("set {} font ',{:g}' offset 0,0\n", label, fontSize);
  }
  const double legendHeight = static_cast<double>(legend.rows) * legendLine * fontSize;
  constexpr double axisLines = 5;  // the numbers and the name of the axis
  // gnuplot knows no widths of a paper's font: it is given where the legend begins.
  return settings +
         fmt::format(
             "set bmargin at screen {:.4f}\nset key default\n"
             "set key at screen {:.4f}, screen {:.4f} left top vertical maxrows {} Left reverse "
             "samplen 1.5 spacing 1.1 font ',{:g}'\n",
             (legendHeight + axisLines * fontSize) / height, legend.left, legendHeight / height,
             legend.rows, fontSize);
}

constexpr double millimetresOfInch = 25.4;

}  // namespace

std::optional<PaperFigure> paperFigure(const PlotSheet& sheet, PaperWidth width, double fontSize) {
  FirstPlot first = firstPlotOf(sheet.commands);
  const Legend legend = fitLegend(first.plot, millimetresOf(width) * pointsOfMillimetre / fontSize);
  if (!sheet.isForPaper || first.plot.empty() || legend.rows == 0) return std::nullopt;
  const double height = (width == PaperWidth::column ? 70 : 84) * pointsOfMillimetre +
                        legendLine * fontSize * static_cast<double>(legend.rows);
  return PaperFigure{sheet.name, millimetresOf(width), height / pointsOfMillimetre, fontSize,
                     colourSettings(sheet) + first.settings +
                         paperSettings(first.settings, legend, fontSize, height) +
                         (width == PaperWidth::column ? sheet.columnCommands : "") + first.plot};
}

std::vector<std::string> paperPdfs(const std::vector<PaperFigure>& figures) {
  std::vector<std::string> scripts;
  for (const PaperFigure& figure : figures) {
    // At 0.8 its points are points. Small letters of the usual plain fonts are higher than a
    // paper's: at 0.68 they look alike.
    scripts.push_back(fmt::format(
        "set encoding utf8\nset terminal pdfcairo size {:.3f}in,{:.3f}in noenhanced font "
        "'sans-serif,{:g}' fontscale 0.68 linewidth 0.5\nset format '%g'\n{}",
        figure.width / millimetresOfInch, figure.height / millimetresOfInch, figure.fontSize,
        figure.commands));
  }
  return undatedPdfs(scripts);
}

}  // namespace gnomon::report
