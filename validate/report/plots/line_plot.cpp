#include "report/plots/line_plot.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "common/error.h"
#include "common/lists.h"
#include "report/plots/gnuplot.h"
#include "report/tables/cost_table.h"
#include "report/terminal_page.h"
#include "report/text/number_text.h"
#include "study/run/scene/view_samples.h"

namespace gnomon::report {

namespace {

/// gnuplot's numbers of the shapes that render::methodSymbols names, in its order, and of outlined
/// ones, which those leave to variants.
constexpr std::array<int, render::methodSymbols.size()> symbolPoints = {7,  5, 9, 11, 13,
                                                                        15, 1, 2, 3};
constexpr std::array<int, 6> outlinedPoints = {6, 4, 8, 10, 12, 14};
constexpr int mostDashes = 5;  ///< of gnuplot's numbers

/// FNV-1a of 32 bits: the same on every machine, so that a label looks the same in every report.
std::uint32_t hashOf(std::string_view text) {
  std::uint32_t hash = 2166136261U;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
  return hash;
}

int pointOf(const std::string& name, const std::string& symbol) {
  const auto found = std::find(render::methodSymbols.begin(), render::methodSymbols.end(), symbol);
  const bool isNamed = found != render::methodSymbols.end();
  return symbolPoints.at(isNamed ? static_cast<std::size_t>(found - render::methodSymbols.begin())
                                 : hashOf(name) % symbolPoints.size());
}

/// gnuplot writes a colour in three ways: "#1a1d21", "rgb( 26,  29,  33)" and "rgb(26,29,33)".
std::string darkRule(const PlotColour& colour) {
  const auto byte = [&](std::size_t i) {
    return std::stoi(std::string(colour.onWhite.substr(1 + 2 * i, 2)), nullptr, 16);
  };
  const std::string padded = fmt::format("rgb({:3}, {:3}, {:3})", byte(0), byte(1), byte(2));
  const std::string plain = fmt::format("rgb({},{},{})", byte(0), byte(1), byte(2));
  return fmt::format(
      "[stroke=\"{0}\"]{{stroke:{2}}}[color=\"{0}\"]{{color:{2}}}"
      "[fill=\"{0}\"],[fill=\"{1}\"],[fill=\"{3}\"]{{fill:{2}}}\n",
      padded, plain, colour.onDark, colour.onWhite);
}

}  // namespace

const std::string& darkStyle() {
  static const std::string style = [] {
    std::string rules = "@media screen and (prefers-color-scheme:dark){\n";
    for (const PlotColour& colour : frameColours) rules += darkRule(colour);
    for (const PlotColour& colour : familyColours) rules += darkRule(colour);
    return rules + "}\n";
  }();
  return style;
}

MethodStyle methodStyle(const std::string& name, const std::string& label,
                        const render::MethodMark& mark) {
  MethodStyle style;
  style.family = mark.family.empty() ? "own" : mark.family;
  if (label == name) {
    style.point = pointOf(name, mark.symbol);
    return style;
  }
  const std::uint32_t hash = hashOf(label);
  constexpr std::uint32_t dashes = mostDashes - 1;
  style.point = outlinedPoints.at(hash % outlinedPoints.size());
  style.dash = 2 + static_cast<int>(hash / outlinedPoints.size() % dashes);
  return style;
}

std::string styleClause(const MethodStyle& style) {
  const auto colour = std::find_if(familyColours.begin(), familyColours.end(),
                                   [&](const auto& known) { return known.name == style.family; });
  return fmt::format("lc rgb '{}' pt {} ps 0.8 lw 2 dt {}", colour->onWhite, style.point,
                     style.dash);
}

namespace {

constexpr const char* bandLegend = "uncertainty of the truth";

/// Rows of x, y, and the ends of the bar.
std::string rowsOf(const std::vector<PlotPoint>& points) {
  std::string rows;
  for (const PlotPoint& point : points) {
    const auto text = [](std::optional<double> value) { return value ? exactText(*value) : "NaN"; };
    rows += fmt::format("{} {}", exactText(point.x), text(point.y));
    if (point.bar) rows += " " + exactText(point.bar->low) + " " + exactText(point.bar->high);
    rows += point.bar ? "\n" : " NaN NaN\n";
  }
  return rows;
}

std::string dataOf(const LinePlot& plot) {
  std::string data = fmt::format("$band << EOD\n{}EOD\n", rowsOf(plot.band));
  for (std::size_t i = 0; i < plot.curves.size(); ++i) {
    data += fmt::format("$c{} << EOD\n{}EOD\n", i, rowsOf(plot.curves[i].points));
  }
  return data;
}

/// The frame, the axes and the curves, without fonts, margins and the legend's place.
std::string frameOf(const LinePlot& plot) {
  return fmt::format(
      "set border 3 lc rgb '{1}'\nset tics nomirror out textcolor rgb '{0}'\n"
      "set grid lc rgb '{2}' lw 1 dt 1\nset key textcolor rgb '{0}'\n"
      "set xlabel {3} textcolor rgb '{0}'\nset ylabel {4} textcolor rgb '{0}'\nset format "
      "'%g'\n{5}",
      inkColour, axisColour, gridColour, gnuplotText(plot.xLabel), gnuplotText(plot.yLabel),
      plot.axes);
}

std::string curvesOf(const LinePlot& plot) {
  std::string text = "plot ";
  if (!plot.band.empty()) {
    text += fmt::format(
        "$band using 1:2 with filledcurves y1=1e-9 fc rgb '{}' fs noborder title '{}', \\\n  ",
        bandColour, bandLegend);
  }
  for (std::size_t i = 0; i < plot.curves.size(); ++i) {
    const PlotCurve& curve = plot.curves[i];
    text += fmt::format("{}$c{} using 1:2 with {} {} title {}", i > 0 ? ", \\\n  " : "", i,
                        curve.with, curve.style, gnuplotText(shortLegend(curve.label)));
    const bool hasBars = std::any_of(curve.points.begin(), curve.points.end(),
                                     [](const PlotPoint& point) { return point.bar.has_value(); });
    if (!hasBars) continue;
    text += fmt::format(
        ", \\\n  $c{} using 1:3:(0):($4-$3) with vectors heads size graph 0.005,90 {} lw 1 dt 1 "
        "notitle",
        i, curve.style.substr(0, curve.style.find(" pt")));
  }
  return text + "\n";
}

}  // namespace

PlotSheet sheetOf(const LinePlot& plot) {
  PlotSheet sheet{plot.name, plot.title, plot.about, plot.section};
  sheet.commands = dataOf(plot) + frameOf(plot) +
                   "set key outside right top Left reverse samplen 2 spacing 1.1 maxcols 1\n" +
                   curvesOf(plot);
  return sheet;
}

std::vector<PlotSheet> sheetsOf(const std::vector<LinePlot>& plots) {
  std::vector<PlotSheet> sheets;
  sheets.reserve(plots.size());
  for (const LinePlot& plot : plots) sheets.push_back(sheetOf(plot));
  return sheets;
}

std::string paperCommands(const LinePlot& plot, double fontSize, std::size_t columns) {
  std::string fonts;
  for (const char* text : {"xtics", "ytics", "xlabel", "ylabel"}) {
    fonts += fmt::format("set {} font ',{:g}'\n", text, fontSize);
  }
  return dataOf(plot) + frameOf(plot) + fonts +
         fmt::format(
             "set key outside bottom center horizontal Left reverse samplen 1.5 spacing 1.1 "
             "maxcols {} font ',{:g}'\n",
             columns, fontSize) +
         curvesOf(plot);
}

MethodStyles::MethodStyles(const study::StudyMeans& study, const std::vector<std::string>& shown) {
  for (const study::MethodMeans& method : study.methods) {
    styles_.emplace_back(method.label, methodStyle(method.name, method.label, method.mark));
  }
  setApart(shown);
}

MethodStyles::MethodStyles(const study::SuiteStatistics& statistics,
                           const std::vector<std::string>& shown) {
  for (const study::SuiteMethod& method : statistics.methods) {
    const std::string& name = method.names.empty() ? method.label : method.names.front();
    styles_.emplace_back(method.label, methodStyle(name, method.label, method.mark));
  }
  setApart(shown);
}

void MethodStyles::setApart(const std::vector<std::string>& shown) {
  std::vector<MethodStyle*> before;
  for (const std::string& label : shown) {
    const auto own = std::find_if(styles_.begin(), styles_.end(),
                                  [&](const auto& style) { return style.first == label; });
    if (own == styles_.end()) continue;
    MethodStyle& style = own->second;
    const auto isTaken = [&](int MethodStyle::*part) {
      return std::any_of(before.begin(), before.end(), [&](const MethodStyle* other) {
        return other->family == style.family && other->*part == style.*part;
      });
    };
    for (std::size_t i = 0; i < outlinedPoints.size() && isTaken(&MethodStyle::point); ++i) {
      style.point = outlinedPoints.at(i);
    }
    for (int dash = 1; dash <= mostDashes && isTaken(&MethodStyle::dash); ++dash) {
      style.dash = dash;
    }
    before.push_back(&style);
  }
}

std::string MethodStyles::of(const std::string& label) const {
  const auto found = std::find_if(styles_.begin(), styles_.end(),
                                  [&](const auto& style) { return style.first == label; });
  if (found == styles_.end()) throw InternalError(fmt::format("no method \"{}\" to draw", label));
  return styleClause(found->second);
}

std::string shortLegend(const std::string& label) {
  constexpr std::size_t longest = 40;
  return displayWidth(label) > longest ? fitLeft(label, longest) : label;
}

BinAxis binAxis(const std::vector<BinEnds>& ends) {
  std::vector<double> edges;
  for (const auto& [low, high] : ends) {
    for (const auto& edge : {low, high}) {
      if (edge) edges.push_back(*edge);
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  const bool isLogarithmic = isGeometric(edges);
  const auto beyond = [&](double edge, double next) {
    return isLogarithmic ? edge * edge / next : 2 * edge - next;
  };
  // One edge alone has no neighbour, none has not even a place.
  const double single = edges.empty() ? 0.5 : edges.front();
  const double left = edges.size() > 1 ? beyond(edges[0], edges[1]) : single - 1;
  const double right =
      edges.size() > 1 ? beyond(edges[edges.size() - 1], edges[edges.size() - 2]) : single + 1;
  BinAxis axis{{}, ends.front().first.value_or(left), ends.back().second.value_or(right), {}};
  for (const auto& [low, high] : ends) {
    const double from = low.value_or(left);
    const double to = high.value_or(right);
    axis.middles.push_back(isLogarithmic ? std::sqrt(from * to) : (from + to) / 2);
  }
  axis.commands = fmt::format("{}set xrange [{}:{}]\n", isLogarithmic ? "set logscale x\n" : "",
                              exactText(axis.left), exactText(axis.right));
  return axis;
}

std::string axisTitle(std::string_view axis) {
  for (const study::SampleAxis& known : study::sampleAxes()) {
    if (known.name != axis) continue;
    return known.unit.empty() ? std::string(known.title)
                              : fmt::format("{}, {}", known.title, known.unit);
  }
  return std::string(axis);
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

namespace {

std::string nameOf(std::span<const study::MethodMeans> methods, const std::string& label) {
  for (const study::MethodMeans& method : methods) {
    if (method.label == label) return method.name;
  }
  return label;
}

/// An entry of a ranking.
struct Ranked {
  std::string label, name;
};

/// Those of the chosen and of the first, in the order of the ranking.
std::vector<std::string> choose(const std::vector<Ranked>& ranked,
                                std::vector<std::string> chosen) {
  std::vector<std::string> names;
  for (const Ranked& entry : ranked) {
    if (contains(chosen, entry.label)) appendOnce(names, entry.name);
  }
  const std::size_t given = chosen.size();
  for (const bool isNew : {true, false}) {
    for (const Ranked& entry : ranked) {
      if (chosen.size() >= std::max(mostPlotted, given)) break;
      if (isNew && contains(names, entry.name)) continue;
      appendOnce(chosen, entry.label);
      appendOnce(names, entry.name);
    }
  }
  std::vector<std::string> ordered;
  for (const Ranked& entry : ranked) {
    if (contains(chosen, entry.label)) ordered.push_back(entry.label);
  }
  return ordered;
}

/// The labels that a report has a method of.
template <typename Method>
std::vector<std::string> amongOwn(const std::vector<std::string>& labels,
                                  const std::vector<Method>& methods) {
  std::vector<std::string> own;
  for (const std::string& label : labels) {
    const bool isOwn = std::any_of(methods.begin(), methods.end(),
                                   [&](const Method& method) { return method.label == label; });
    if (isOwn) own.push_back(label);
  }
  return own;
}

}  // namespace

std::optional<std::string> labelOf(std::span<const study::MethodMeans> methods,
                                   std::string_view name) {
  std::optional<std::string> first;
  for (const study::MethodMeans& method : methods) {
    if (method.name != name) continue;
    if (method.label == name) return method.label;
    if (!first) first = method.label;
  }
  return first;
}

std::optional<std::string> bestMethod(const std::vector<study::RankedMethod>& ranked) {
  for (const study::RankedMethod& method : ranked) {
    if (method.rank && method.means.name != controlMethod) return method.label;
  }
  return std::nullopt;
}

std::optional<std::string> claimedMethod(std::span<const study::MethodMeans> methods,
                                         std::span<const study::ClaimRecord> claims) {
  for (const study::ClaimRecord& claim : claims) {
    for (const std::string& label : claim.methods) {
      const std::string name = nameOf(methods, label);
      if (name != costReference && name != controlMethod) return label;
    }
  }
  return std::nullopt;
}

std::vector<std::string> plottedMethods(const study::StudyMeans& study,
                                        const std::vector<std::string>& wanted) {
  if (auto own = amongOwn(wanted, study.methods); !own.empty()) return own;
  std::vector<Ranked> ranked;
  for (const study::RankedOverStudies& method : study::rankOverStudies(std::array{study})) {
    ranked.push_back({method.label, nameOf(study.methods, method.label)});
  }
  std::vector<std::string> chosen;
  for (const auto& label :
       {labelOf(study.methods, costReference), claimedMethod(study.methods, study.claims)}) {
    if (label) appendOnce(chosen, *label);
  }
  return choose(ranked, std::move(chosen));
}

std::vector<std::string> plottedMethods(const study::SuiteStatistics& statistics,
                                        const std::vector<std::string>& wanted) {
  if (auto own = amongOwn(wanted, statistics.methods); !own.empty()) return own;
  std::vector<Ranked> ranked;
  std::vector<std::string> chosen;
  for (const study::SuiteMethod& method : statistics.methods) {
    ranked.push_back({method.label, method.names.empty() ? method.label : method.names.front()});
    if (chosen.empty() && contains(method.names, costReference)) chosen.push_back(method.label);
  }
  return choose(ranked, std::move(chosen));
}

}  // namespace gnomon::report
