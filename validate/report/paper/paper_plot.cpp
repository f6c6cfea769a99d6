#include "report/paper/paper_plot.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "report/paper/tikz_picture.h"
#include "report/plots/gnuplot.h"
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

/// The entries of the legend.
std::vector<std::string> titlesOf(const std::string& plot) {
  constexpr std::string_view word = " title '";
  std::vector<std::string> titles;
  for (std::size_t at = 0; (at = plot.find(word, at)) != std::string::npos;) {
    at += word.size();
    titles.push_back(plot.substr(at, plot.find('\'', at) - at));
  }
  return titles;
}

/// The legend's columns and rows.
struct Legend {
  std::size_t columns = 1, rows = 0;
};

Legend legendOf(const std::vector<std::string>& titles, double width, double fontSize) {
  if (titles.empty()) return {};
  double longest = 0;
  for (const std::string& title : titles) longest = std::max(longest, latexWidth(title));
  constexpr double symbol = 3.5;  // with its gaps, in units of the font's size
  const double room = width * pointsOfMillimetre / fontSize;
  const auto fitting = static_cast<std::size_t>(std::max(1.0, room / (longest + symbol)));
  const std::size_t columns = std::min({fitting, titles.size(), std::size_t{4}});
  return {columns, (titles.size() + columns - 1) / columns};
}

/// What the page has said of margins, fonts and the legend, anew.
std::string paperSettings(const Legend& legend, double fontSize) {
  std::string settings = "set lmargin\nset rmargin\nset tmargin\nset bmargin\nunset title\n";
  for (const char* axis : {"xtics", "x2tics", "ytics"}) {
    settings += fmt::format("set {} font ',{:g}'\n", axis, fontSize);
  }
  for (const char* label : {"xlabel", "x2label", "ylabel"}) {
    settings += fmt::format("set {} font ',{:g}' offset 0,0\n", label, fontSize);
  }
  return settings + fmt::format(
                        "set key default\nset key below horizontal Left reverse samplen 1.5 "
                        "spacing 1 width 0 font ',{:g}' maxcols {}\n",
                        fontSize, legend.columns);
}

constexpr double millimetresOfInch = 25.4;
constexpr double millimetresOfPoint = 1 / pointsOfMillimetre;

std::vector<std::string> scriptsOf(const std::vector<PaperFigure>& figures,
                                   std::string (*terminalOf)(const PaperFigure&)) {
  std::vector<std::string> scripts;
  for (const PaperFigure& figure : figures) {
    // Numbers without the spaces and the signs of mathematics that some terminals give them.
    scripts.push_back("set encoding utf8\n" + terminalOf(figure) + "set format '%g'\n" +
                      figure.commands);
  }
  return scripts;
}

}  // namespace

std::optional<PaperFigure> paperFigure(const PlotSheet& sheet, PaperWidth width, double fontSize) {
  const FirstPlot first = firstPlotOf(sheet.commands);
  const Legend legend = legendOf(titlesOf(first.plot), millimetresOf(width), fontSize);
  if (!sheet.isForPaper || first.plot.empty() || legend.rows == 0) return std::nullopt;
  const double plotHeight = width == PaperWidth::column ? 62 : 80;
  const double line = 1.3 * fontSize * millimetresOfPoint;
  return PaperFigure{
      sheet.name, millimetresOf(width), plotHeight + line * static_cast<double>(legend.rows),
      fontSize,
      colourSettings(sheet) + first.settings + paperSettings(legend, fontSize) + first.plot};
}

std::vector<std::string> paperPdfs(const std::vector<PaperFigure>& figures) {
  return undatedPdfs(scriptsOf(figures, [](const PaperFigure& figure) {
    return fmt::format(
        "set terminal pdfcairo size {:.3f}in,{:.3f}in noenhanced font 'sans-serif,{:g}' "
        "linewidth 0.5\n",
        figure.width / millimetresOfInch, figure.height / millimetresOfInch, figure.fontSize);
  }));
}

std::vector<std::string> paperPgfs(const std::vector<PaperFigure>& figures) {
  std::vector<std::string> pictures =
      drawByGnuplot(scriptsOf(figures, [](const PaperFigure& figure) {
        return fmt::format("set terminal tikz size {:.3f}cm,{:.3f}cm font ',{:g}'\n",
                           figure.width / 10, figure.height / 10, figure.fontSize);
      }));
  for (std::string& picture : pictures) picture = tikzPicture(picture);
  return pictures;
}

}  // namespace gnomon::report
