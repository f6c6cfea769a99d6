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
#include "report/text/interval_text.h"
#include "report/text/number_text.h"
#include "report/text/ranking_text.h"

namespace gnomon::report {
namespace {

/// The least error that a logarithmic axis shows, percent.
constexpr double leastShown = 0.01;

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
  if (!study::isDistinguishable(pair.verdict)) return "0xffffff";
  const double lead = 2 * pair.wins.probability - 1;
  constexpr std::array<int, 3> blue = {0x00, 0x72, 0xb2};
  constexpr std::array<int, 3> orange = {0xd5, 0x5e, 0x00};
  return tint(lead > 0 ? blue : orange, std::abs(lead));
}

std::string cellText(const study::SuitePair& pair) {
  return fmt::format("{:.0f}{}", 100 * pair.wins.probability, differenceSign(pair.verdict));
}

/// White on strong tints.
std::string textColour(const study::SuitePair& pair) {
  if (!study::isDistinguishable(pair.verdict)) return "0x5b626b";
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

/// The mean uncertainty of the truth, the largest over the methods; 0 where none was measured.
double largestUncertainty(const study::SuiteStatistics& statistics) {
  double largest = 0;
  for (const study::SuiteMethod& method : statistics.methods) {
    largest = std::max(largest, method.uncertainty);
  }
  return largest;
}

/// Where a panel lies.
PlotMargins panelMargins(std::size_t place, const PlotSheet& sheet) {
  const auto at = static_cast<int>(place);
  if (sheet.place == PlotPlace::phone) {
    const int each = sheet.height / static_cast<int>(panelAxes.size());
    return {46, 8, at * each + 12, sheet.height - (at + 1) * each + 62};
  }
  const int half = sheet.height / 2;
  const int top = (at < 2 ? 0 : half) + 20;
  const int bottom = sheet.height - top - half + 84;
  if (sheet.place == PlotPlace::page) {
    return at % 2 == 0 ? PlotMargins{60, 520, top, bottom} : PlotMargins{560, 12, top, bottom};
  }
  return at % 2 == 0 ? PlotMargins{60, 660, top, bottom} : PlotMargins{410, 310, top, bottom};
}

struct Panels {
  std::string data, plots;
};

void addValues(const study::SuiteStatistics& statistics, const std::string& method,
               const std::string& axis, const std::vector<Ends>& ends, double shift,
               ValuePoints& values, PlotSheet& sheet) {
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const study::SuiteBin* bin = findBin(statistics, method, axis, ends[i]);
    if (bin == nullptr) continue;
    const double error = bin->error.errorRate;
    const std::string interval =
        bin->error.interval ? fmt::format(" (95 % interval {})", intervalText(bin->error.interval))
                            : "";
    values.add(sheet, static_cast<double>(i) + shift, std::max(leastShown, 100 * error),
               fmt::format("{}: {} %{}, {} {}", method, percentText(error), interval,
                           axisTitle(axis), binText(ends[i].first, ends[i].second)));
  }
  values.endCurve();
}

void addPanel(const study::SuiteStatistics& statistics, const std::vector<std::string>& methods,
              const MethodStyles& styles, std::size_t place, Panels& panels, PlotSheet& sheet) {
  const std::string axis = panelAxes.at(place);
  const std::vector<Ends> ends = endsOf(statistics, axis);
  if (ends.empty()) return;
  std::string plot;
  ValuePoints values(fmt::format("$v{}m", place));
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
    addValues(statistics, methods[m], axis, ends, shift, values, sheet);
  }
  panels.data += values.data(sheet);
  // Edges of many digits would meet.
  const std::string edges = ticks(ends);
  const bool isNarrow = sheet.place == PlotPlace::phone;
  const char* turned = edges.size() > (isNarrow ? 90 : 120) ? "rotate by 35 right" : "norotate";
  panels.plots +=
      plotMargins(panelMargins(place, sheet), sheet.width, sheet.height) +
      fmt::format("set xtics {} ({})\nset xrange [-0.5:{}]\nset xlabel {} offset 0,0.4\n{}{}\n{}\n",
                  turned, edges, exactText(static_cast<double>(ends.size()) - 0.5),
                  gnuplotText(axisTitle(axis)), plot, values.plot(sheet),
                  "unset key\nunset label 1");
}

/// The errors behind the curves: a row a method, a column a share of the scenes.
Table errorsTable(const study::SuiteStatistics& statistics,
                  const std::vector<std::vector<double>>& all) {
  constexpr std::array shares = {10, 25, 50, 75, 90, 95, 100};
  Table table{.kind = "values", .columns = {{"Method", "", Quantity::name}}};
  for (const int share : shares) {
    table.columns.push_back({fmt::format("{} % of the scenes", share), "", Quantity::percent});
  }
  for (std::size_t m = 0; m < all.size(); ++m) {
    Row row{{textCell(statistics.methods[m].label)}};
    for (const int share : shares) {
      const std::size_t count =
          (all[m].size() * static_cast<std::size_t>(share) + 99) / 100;  // rounded up
      row.cells.push_back(valueCell(all[m].at(std::max<std::size_t>(1, count) - 1) / 100));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

PlotSheet suiteErrorsPlot(const study::SuiteStatistics& statistics, PlotPlace place) {
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
  const MethodStyles styles(statistics);
  const int lines = static_cast<int>(all.size()) + 4;
  PlotSheet sheet{.name = "suite-errors",
                  .title = "Share of the scenes with an error below",
                  .about = "Share of the scenes with no more than an error rate, a curve a method",
                  .height = place == PlotPlace::paper ? std::max(560, 25 * lines) : 460,
                  .colours = styles.colours(),
                  .place = place,
                  .table = errorsTable(statistics, all)};
  PlotMargins margins{75, 310, 12, 68};
  if (place == PlotPlace::page) margins.right = 12;
  if (place == PlotPlace::phone) {
    sheet.width = sheet.height = 380;
    margins = {48, 10, 10, 64};
  }
  std::string data;
  std::string plot;
  std::vector<std::string> labels;
  std::vector<LegendEntry> legend;
  for (const study::SuiteMethod& method : statistics.methods) {
    labels.push_back(method.label);
    legend.push_back({method.label, method.label});
  }
  ValuePoints values("$values");
  for (const std::string& label : styles.drawnOrder(labels)) {
    const auto m =
        static_cast<std::size_t>(std::find(labels.begin(), labels.end(), label) - labels.begin());
    data += fmt::format("$m{} << EOD\n{}EOD\n", m, curve(all[m], left, right));
    // Its symbol at some of the scenes, of few at all.
    constexpr std::size_t symbols = 10;
    const std::size_t step = 1 + all[m].size() / symbols;
    plot += fmt::format(
        "{}$m{} using 1:2 with steps {} notitle, \\\n  $m{} using 1:2 every {}::1::{} with points "
        "{} notitle",
        plot.empty() ? "plot " : ", \\\n  ", m, styles.stroke(label), m, step, all[m].size(),
        styles.points(label));
    for (std::size_t i = 0; i < all[m].size(); i += step) {
      const double share = 100 * static_cast<double>(i + 1) / static_cast<double>(all[m].size());
      values.add(sheet, all[m][i], share,
                 fmt::format("{}: {} % or less on {:.0f} % of the scenes", label,
                             percentText(all[m][i] / 100), share));
    }
    values.endCurve();
  }
  plot += styles.legend(legend, "linespoints", &MethodStyles::line);
  sheet.legend = styles.items(legend, true);
  const double uncertainty = 100 * largestUncertainty(statistics);
  std::string band;
  if (uncertainty > left) {
    band = fmt::format(
        "set object 1 rectangle from graph 0, graph 0 to first {}, graph 1 fc rgb band fs solid "
        "noborder behind\n",
        exactText(uncertainty));
    plot += plotBandEntry();
    sheet.legend.push_back(bandItem());
  }
  sheet.commands =
      data + values.data(sheet) + plotFrame() + "set logscale x\nset format x '%g'\n" + band +
      fmt::format("set xrange [{}:{}]\nset yrange [0:100]\n", exactText(left), exactText(right)) +
      plotMargins(margins, sheet.width, sheet.height) +
      fmt::format("set xlabel '{}, percent of {}' offset 0,0.5\n",
                  statistics.isSoft ? "mean |ΔV|" : "error rate", suiteFigure(statistics).of) +
      "set ylabel 'scenes with no more, percent' offset 1,0\n" +
      (place == PlotPlace::paper ? "set key at screen 0.7, screen 0.97 left top Left reverse "
                                   "samplen 3 spacing 1.1 maxcols 1\n"
                                 : "unset key\n") +
      plot + values.plot(sheet) + "\n";
  return sheet;
}

PlotSheet suiteWinsPlot(const study::SuiteStatistics& statistics, PlotPlace place) {
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
      commands,
      "plots",
      {},
      place,
      {},
      {},
      {},
      true};
}

std::optional<PlotSheet> suiteBinsPlot(const study::SuiteStatistics& statistics, PlotPlace place) {
  const MethodStyles styles(statistics);
  const std::vector<std::string> methods = shownMethods(statistics, styles);
  if (methods.empty()) return std::nullopt;
  PlotSheet sheet{.name = "suite-bins",
                  .title = "Where methods fail",
                  .about =
                      "Error rate by curvature times height, elevation of the light, reach of "
                      "shadows and stretch of the texture",
                  .height = 680,
                  .colours = styles.colours(),
                  .place = place};
  if (place == PlotPlace::phone) {
    sheet.width = 380;
    sheet.height = 1120;
  }
  Panels panels;
  for (std::size_t axis = 0; axis < panelAxes.size(); ++axis) {
    addPanel(statistics, methods, styles, axis, panels, sheet);
  }
  if (panels.plots.empty()) return std::nullopt;
  std::vector<LegendEntry> legend;
  legend.reserve(methods.size());
  for (const std::string& method : methods) legend.push_back({method, method});
  sheet.legend = styles.items(legend, true);
  const double uncertainty = 100 * largestUncertainty(statistics);
  const bool hasBand = uncertainty > leastShown;
  if (hasBand) sheet.legend.push_back(bandItem());
  sheet.commands =
      panels.data + plotFrame(3, "ytics ") +
      "set tics font ',9'\n"
      "set xlabel font ',12'\n"
      "set logscale y\nset format y '%g'\n" +
      errorRange(statistics, methods) + (hasBand ? plotBandBelow(uncertainty) : "") +
      (place == PlotPlace::phone
           ? "set ylabel 'error, percent' offset 2,0 font ',11'\n"
           : "set label 1 " + gnuplotText(binErrorAxis(statistics.isSoft)) +
                 " at screen 0.012, screen 0.52 center rotate textcolor rgb ink\n") +
      (place == PlotPlace::paper ? "set key at screen 0.7, screen 0.975 left top Left reverse "
                                   "samplen 2 spacing 1.1 maxcols 1\n"
                                 : "unset key\n") +
      "set multiplot\n" + panels.plots + "unset multiplot\n";
  return sheet;
}

std::vector<PlotSheet> suitePlots(const study::SuiteStatistics& statistics, PlotPlace place) {
  std::vector<PlotSheet> sheets;
  if (statistics.methods.empty()) return sheets;
  sheets.push_back(suiteErrorsPlot(statistics, place));
  if (statistics.methods.front().rank) sheets.push_back(suiteWinsPlot(statistics, place));
  if (auto bins = suiteBinsPlot(statistics, place)) {
    bins->isForPaper = false;
    sheets.push_back(std::move(*bins));
  }
  return sheets;
}

}  // namespace gnomon::report
