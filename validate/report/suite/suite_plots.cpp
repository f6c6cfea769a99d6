#include "report/suite/suite_plots.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "common/lists.h"
#include "report/plots/bin_plot.h"
#include "report/plots/method_styles.h"
#include "report/plots/plot_style.h"
#include "report/suite/suite_tables.h"
#include "report/text/number_text.h"

namespace gnomon::report {
namespace {

/// The least error that a logarithmic axis shows, percent.
constexpr double leastShown = 0.01;

constexpr const char* openFrame =
    "set border 3 lc rgb axis\n"
    "set tics nomirror out textcolor rgb ink\n";

// ---- the cumulative plot

std::vector<double> sortedErrors(const study::SuiteStatistics& statistics,
                                 const std::string& label) {
  const compare::SceneTable& table = statistics.table;
  const auto found = std::find(table.methods.begin(), table.methods.end(), label);
  std::vector<double> errors;
  for (const auto& error :
       table.errors.at(static_cast<std::size_t>(found - table.methods.begin()))) {
    if (error) errors.push_back(std::max(leastShown, 100 * *error));
  }
  std::sort(errors.begin(), errors.end());
  return errors;
}

/// From the axis's left end to its right end.
std::string curve(const std::vector<double>& errors, double left, double right) {
  const auto count = static_cast<double>(errors.size());
  std::string rows = fmt::format("{} 0\n", exactText(left));
  for (std::size_t i = 0; i < errors.size(); ++i) {
    rows += fmt::format("{} {}\n", exactText(errors[i]),
                        exactText(100 * static_cast<double>(i + 1) / count));
  }
  return rows + fmt::format("{} 100\n", exactText(right));
}

// ---- the matrix of wins

/// A colour between white and another.
std::string tint(const std::array<int, 3>& full, double strength) {
  const auto part = [&](int channel) {
    return static_cast<int>(std::lround(255 + strength * (channel - 255)));
  };
  return fmt::format("0x{:02x}{:02x}{:02x}", part(full[0]), part(full[1]), part(full[2]));
}

std::string cellColour(const study::SuitePair& pair) {
  if (pair.verdict == study::DifferenceVerdict::notDistinguishable) return "0xffffff";
  const double lead = 2 * pair.wins.probability - 1;
  constexpr std::array<int, 3> blue = {0x00, 0x72, 0xb2};
  constexpr std::array<int, 3> orange = {0xd5, 0x5e, 0x00};
  return tint(lead > 0 ? blue : orange, std::abs(lead));
}

std::string cellText(const study::SuitePair& pair) {
  const std::string text = fmt::format("{:.0f}", 100 * pair.wins.probability);
  return pair.verdict == study::DifferenceVerdict::notDistinguishable ? text + " ≈" : text;
}

/// White on strong tints.
std::string textColour(const study::SuitePair& pair) {
  if (pair.verdict == study::DifferenceVerdict::notDistinguishable) return "0x5b626b";
  return std::abs(2 * pair.wins.probability - 1) > 0.6 ? "0xffffff" : "0x1a1d21";
}

std::vector<const study::SuiteMethod*> rankedMethods(const study::SuiteStatistics& statistics) {
  std::vector<const study::SuiteMethod*> ranked;
  for (const study::SuiteMethod& method : statistics.methods) {
    if (method.rank) ranked.push_back(&method);
  }
  return ranked;
}

// ---- the panels

using Ends = std::pair<std::optional<double>, std::optional<double>>;

/// What is plotted: of the highlighted methods those with a rank.
std::vector<std::string> shownMethods(const study::SuiteStatistics& statistics,
                                      const MethodStyles& styles) {
  std::vector<std::string> shown;
  for (const study::SuiteMethod* method : rankedMethods(statistics)) {
    if (styles.isHighlighted(method->label)) shown.push_back(method->label);
  }
  return shown;
}

const study::SuiteBin* findBin(const study::SuiteStatistics& statistics, const std::string& method,
                               const std::string& axis, const Ends& ends) {
  for (const study::SuiteBin& bin : statistics.bins) {
    if (bin.method == method && bin.axis == axis && Ends{bin.low, bin.high} == ends) return &bin;
  }
  return nullptr;
}

std::vector<Ends> endsOf(const study::SuiteStatistics& statistics, const std::string& axis) {
  std::vector<Ends> ends;
  for (const study::SuiteBin& bin : statistics.bins) {
    if (bin.axis == axis) appendOnce(ends, Ends{bin.low, bin.high});
  }
  std::sort(ends.begin(), ends.end());
  return ends;
}

/// What stands between two bins.
std::string edgeBetween(const Ends& left, const Ends& right) {
  const auto text = [](const std::optional<double>& edge) { return edge ? exactText(*edge) : ""; };
  if (left.second == right.first) return text(left.second);
  return text(left.second) + "…" + text(right.first);
}

std::string ticks(const std::vector<Ends>& ends) {
  // A single bin has no edge.
  std::string edges =
      ends.size() == 1 ? gnuplotText(binText(ends.front().first, ends.front().second)) + " 0" : "";
  for (std::size_t i = 1; i < ends.size(); ++i) {
    edges +=
        fmt::format("{}{} {}", i > 1 ? ", " : "", gnuplotText(edgeBetween(ends[i - 1], ends[i])),
                    exactText(static_cast<double>(i) - 0.5));
  }
  return edges;
}

/// x, error, low, high of each bin, in percent; NaN where there is nothing.
/// @param shift  so that the methods' bars stand beside each other
std::string binRows(const study::SuiteStatistics& statistics, const std::string& method,
                    const std::string& axis, const std::vector<Ends>& ends, double shift) {
  const auto shown = [](double share) { return exactText(std::max(leastShown, 100 * share)); };
  std::string rows;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const study::SuiteBin* bin = findBin(statistics, method, axis, ends[i]);
    const std::string x = exactText(static_cast<double>(i) + shift);
    if (bin == nullptr) {
      rows += x + " NaN NaN NaN\n";
      continue;
    }
    const double error = bin->error.errorRate;
    const compare::Interval bar = bin->error.interval.value_or(compare::Interval{error, error});
    rows += fmt::format("{} {} {} {}\n", x, shown(error), shown(bar.low), shown(bar.high));
  }
  return rows;
}

constexpr std::array<const char*, 4> panelAxes = {"curvature_height", "elevation", "shadow_reach",
                                                  "uv_stretch"};

/// One for all panels, so that they can be compared: of the errors, not of their intervals.
std::string errorRange(const study::SuiteStatistics& statistics,
                       const std::vector<std::string>& methods) {
  double least = 1;
  double most = leastShown / 100;
  for (const study::SuiteBin& bin : statistics.bins) {
    if (!contains(methods, bin.method) || !contains(panelAxes, bin.axis)) continue;
    least = std::min(least, bin.error.errorRate);
    most = std::max(most, bin.error.errorRate);
  }
  return fmt::format("set yrange [{}:{}]\n", exactText(std::max(leastShown, 100 * least) / 1.5),
                     exactText(std::min(120.0, 150 * most)));
}

struct Panels {
  std::string data, plots;
};

void addPanel(const study::SuiteStatistics& statistics, const std::vector<std::string>& methods,
              const MethodStyles& styles, std::size_t place, Panels& panels) {
  const std::string axis = panelAxes.at(place);
  const std::vector<Ends> ends = endsOf(statistics, axis);
  if (ends.empty()) return;
  const double left = place % 2 == 0 ? 0.06 : 0.41;
  const double top = place < 2 ? 0.97 : 0.47;
  std::string plot;
  for (std::size_t m = 0; m < methods.size(); ++m) {
    const double shift =
        0.5 * (static_cast<double>(m) + 0.5) / static_cast<double>(methods.size()) - 0.25;
    const std::string name = fmt::format("$p{}m{}", place, m);
    panels.data +=
        fmt::format("{} << EOD\n{}EOD\n", name, binRows(statistics, methods[m], axis, ends, shift));
    plot += fmt::format(
        "{}{} using 1:3:(0):($4-$3) with vectors nohead {} lw 1 dt 1 notitle, \\\n"
        "  {} using 1:2 with linespoints {} title {}",
        m == 0 ? "plot " : ", \\\n  ", name, styles.colour(methods[m]), name,
        styles.line(methods[m]), plotLegend(methods[m]));
  }
  // Edges of many digits would meet.
  const std::string edges = ticks(ends);
  const char* turned = edges.size() > 120 ? "rotate by 35 right" : "norotate";
  panels.plots += fmt::format(
      "set lmargin at screen {:.3f}\nset rmargin at screen {:.3f}\n"
      "set tmargin at screen {:.3f}\nset bmargin at screen {:.3f}\n"
      "set xtics {} ({})\nset xrange [-0.5:{}]\nset xlabel {} offset 0,0.4\n{}\n{}\n",
      left, left + 0.28, top, top - 0.36, turned, edges,
      exactText(static_cast<double>(ends.size()) - 0.5), gnuplotText(axisTitle(axis)), plot,
      "unset key\nunset label 1");
}

}  // namespace

PlotSheet suiteErrorsPlot(const study::SuiteStatistics& statistics) {
  std::vector<std::vector<double>> all;
  double left = 100;
  double right = leastShown;
  for (const study::SuiteMethod& method : statistics.methods) {
    all.push_back(sortedErrors(statistics, method.label));
    left = std::min(left, all.back().front());
    right = std::max(right, all.back().back());
  }
  left = std::max(leastShown, left / 1.2);
  right = std::min(100.0, 1.2 * right);
  std::string data;
  std::string plot;
  const MethodStyles styles(statistics);
  std::vector<std::string> labels;
  std::vector<LegendEntry> legend;
  for (const study::SuiteMethod& method : statistics.methods) {
    labels.push_back(method.label);
    legend.push_back({method.label, method.label});
  }
  for (const std::string& label : styles.drawnOrder(labels)) {
    const auto m =
        static_cast<std::size_t>(std::find(labels.begin(), labels.end(), label) - labels.begin());
    data += fmt::format("$m{} << EOD\n{}EOD\n", m, curve(all[m], left, right));
    // Its symbol at some of the scenes, that of all of few.
    constexpr std::size_t symbols = 10;
    plot += fmt::format(
        "{}$m{} using 1:2 with steps {} notitle, \\\n  $m{} using 1:2 every {}::1::{} with points "
        "{} "
        "notitle",
        plot.empty() ? "plot " : ", \\\n  ", m, styles.stroke(label), m,
        1 + all[m].size() / symbols, all[m].size(), styles.points(label));
  }
  plot += styles.legend(legend, "linespoints", &MethodStyles::line);
  const std::string commands =
      data + openFrame +
      "set grid lc rgb grid lw 1 dt 1\n"
      "set logscale x\nset format x '%g'\n" +
      fmt::format("set xrange [{}:{}]\nset yrange [0:100]\n", exactText(left), exactText(right)) +
      "set lmargin at screen 0.075\nset rmargin at screen 0.69\n" +
      fmt::format("set xlabel '{}, percent of {}'\n",
                  statistics.isSoft ? "mean |ΔV|" : "error rate", suiteFigure(statistics).of) +
      "set ylabel 'scenes with no more, percent' offset 1,0\n"
      "set key at screen 0.7, screen 0.97 left top Left reverse samplen 3 spacing 1.1 maxcols 1\n" +
      plot + "\n";
  return {"suite-errors",
          "Share of the scenes with an error below",
          "Share of the scenes with no more than an error rate, a curve a method",
          1000,
          std::max(560, 25 * (static_cast<int>(all.size()) + 4)),
          commands,
          "plots",
          styles.colours()};
}

PlotSheet suiteWinsPlot(const study::SuiteStatistics& statistics) {
  const std::vector<const study::SuiteMethod*> ranked = rankedMethods(statistics);
  const std::size_t count = ranked.size();
  std::string cells;
  std::string texts;
  std::string rowNames;
  std::string columnNames;
  for (std::size_t r = 0; r < count; ++r) {
    const std::string label = ranked[r]->label;
    const std::string shown =
        displayWidth(label) > longestLegend ? fitLeft(label, longestLegend) : label;
    const char* comma = r > 0 ? ", " : "";
    rowNames += fmt::format("{}{} {}", comma, gnuplotText(fmt::format("{}  {}", shown, r + 1)), r);
    columnNames += fmt::format("{}'{}' {}", comma, r + 1, r);
    for (std::size_t c = 0; c < count; ++c) {
      const auto pair = study::findPair(statistics, label, ranked[c]->label);
      if (r == c || !pair) {
        cells += fmt::format("{} {} 0xe6e8eb\n", c, r);
        continue;
      }
      cells += fmt::format("{} {} {}\n", c, r, cellColour(*pair));
      texts += fmt::format("{} {} \"{}\" {}\n", c, r, cellText(*pair), textColour(*pair));
    }
  }
  constexpr int cellWidth = 34;
  constexpr int cellHeight = 26;
  constexpr int labelWidth = 320;
  constexpr int headHeight = 44;
  const int width = std::max(500, labelWidth + cellWidth * static_cast<int>(count) + 20);
  const int height = headHeight + cellHeight * static_cast<int>(count) + 16;
  const auto screen = [](int pixels, int of) { return static_cast<double>(pixels) / of; };
  const std::string commands = fmt::format(
      "$cells << EOD\n{}EOD\n$texts << EOD\n{}EOD\n"
      "unset border\nunset key\n"
      "set tics scale 0 textcolor rgb ink\n"
      "set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\n"
      "set tmargin at screen {:.4f}\nset bmargin at screen {:.4f}\n"
      "set ytics ({})\nset x2tics ({}) offset 0,-0.4\nunset xtics\n"
      "set xrange [-0.5:{}]\nset x2range [-0.5:{}]\nset yrange [{}:-0.5]\n"
      "plot $cells using 1:2:(0.48):(0.47):3 with boxxyerror fs solid 1 noborder lc rgb variable, "
      "\\\n  $texts using 1:2:3:4 with labels font ',10' tc rgb variable\n",
      cells, texts, screen(labelWidth, width),
      screen(labelWidth + cellWidth * static_cast<int>(count), width),
      1 - screen(headHeight, height), screen(16, height), rowNames, columnNames,
      exactText(static_cast<double>(count) - 0.5), exactText(static_cast<double>(count) - 0.5),
      exactText(static_cast<double>(count) - 0.5));
  return {
      "suite-wins",
      "Who beats whom",
      "Matrix of methods: the probability, in percent, that the method of the row has a smaller "
      "error than that of the column on a new scene",
      width,
      height,
      commands};
}

std::optional<PlotSheet> suiteBinsPlot(const study::SuiteStatistics& statistics) {
  const MethodStyles styles(statistics);
  const std::vector<std::string> methods = shownMethods(statistics, styles);
  if (methods.empty()) return std::nullopt;
  Panels panels;
  for (std::size_t place = 0; place < panelAxes.size(); ++place) {
    addPanel(statistics, methods, styles, place, panels);
  }
  if (panels.plots.empty()) return std::nullopt;
  const std::string commands =
      panels.data + openFrame +
      "set grid ytics lc rgb grid lw 1 dt 1\n"
      "set tics font ',9'\n"
      "set xlabel font ',12'\n"
      "set logscale y\nset format y '%g'\n" +
      errorRange(statistics, methods) +
      "set label 1 'error rate, percent of the bin’s samples' at screen 0.012, screen 0.52 center "
      "rotate\n"
      "set key at screen 0.7, screen 0.975 left top Left reverse samplen 2 spacing 1.1 maxcols "
      "1\n"
      "set multiplot\n" +
      panels.plots + "unset multiplot\n";
  return PlotSheet{"suite-bins",
                   "Where methods fail",
                   "Error rate by curvature times height, elevation of the light, reach of shadows "
                   "and stretch of the texture",
                   1000,
                   680,
                   commands,
                   "plots",
                   styles.colours()};
}

std::vector<PlotSheet> suitePlots(const study::SuiteStatistics& statistics) {
  std::vector<PlotSheet> sheets;
  if (statistics.methods.empty()) return sheets;
  sheets.push_back(suiteErrorsPlot(statistics));
  if (statistics.methods.front().rank) sheets.push_back(suiteWinsPlot(statistics));
  if (auto bins = suiteBinsPlot(statistics)) sheets.push_back(std::move(*bins));
  return sheets;
}

}  // namespace gnomon::report
