#include "report/plots/budget_plot.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "report/plots/plot_style.h"
#include "report/text/budget_text.h"
#include "report/text/number_text.h"
#include "study/run/stages/budget.h"

namespace gnomon::report {
namespace {

/// Paul Tol's "muted" scheme in an order that sets light beside dark, and one of his oranges: the
/// common colour vision deficiencies keep them apart.
constexpr std::array<const char*, 10> causeColours = {"#332288", "#88ccee", "#117733", "#ddcc77",
                                                      "#cc6677", "#44aa99", "#882255", "#999933",
                                                      "#aa4499", "#ee7733"};

/// What is left has no colour: greys in the order of budgetRestNames.
constexpr std::array<const char*, 4> restColours = {"#3a3a3a", "#6a6a6a", "#999999", "#c8c8c8"};

/// A part of the errors: what the legend calls it, and its rectangles in all bars.
struct BudgetPart {
  std::string name;
  std::string colour;
  std::string rectangles = {};  ///< lines of gnuplot's data
};

BudgetPart& partNamed(std::vector<BudgetPart>& parts, const std::string& name) {
  return *std::find_if(parts.begin(), parts.end(),
                       [&](const BudgetPart& part) { return part.name == name; });
}

/// The causes in the order in which they first appear, then what is left.
std::vector<BudgetPart> partsOf(std::span<const study::BudgetRecord> budgets) {
  std::vector<BudgetPart> parts;
  for (const study::BudgetRecord& budget : budgets) {
    for (const study::BudgetCause& cause : budget.causes) {
      const bool isThere = std::any_of(parts.begin(), parts.end(), [&](const BudgetPart& part) {
        return part.name == cause.name;
      });
      if (isThere) continue;
      parts.push_back({cause.name, causeColours.at(parts.size() % causeColours.size())});
    }
  }
  std::size_t grey = 0;
  for (const std::string_view name : study::budgetRestNames()) {
    parts.push_back({restName(name), restColours.at(grey++)});
  }
  return parts;
}

/// Adds the bar of one order at a height: shares above 0 stand to the right of zero one after the
/// other, those below it to its left.
void addBar(std::vector<BudgetPart>& parts, const study::BudgetRecord& budget,
            study::BudgetShare study::BudgetCause::*way, double y) {
  double below = 0;
  double above = 0;
  const auto add = [&](const std::string& name, double share) {
    double& end = share < 0 ? below : above;
    const double from = std::min(end, end + share);
    const double to = std::max(end, end + share);
    end += share;
    if (!(from < to)) return;
    partNamed(parts, name).rectangles += fmt::format(
        "{} {} {} {} {} {}\n", exactText(50 * (from + to)), exactText(y), exactText(100 * from),
        exactText(100 * to), exactText(y - 0.4), exactText(y + 0.4));
  };
  for (const study::BudgetCause& cause : budget.causes) add(cause.name, (cause.*way).value);
  for (const study::BudgetRest& rest : budget.rest) add(restName(rest.name), rest.share.value);
}

}  // namespace

PlotSheet budgetPlot(std::span<const study::BudgetRecord> budgets, PlotPlace place, bool isSoft) {
  std::vector<BudgetPart> parts = partsOf(budgets);
  std::string names;
  std::string totals;
  double y = 0;
  for (const study::BudgetRecord& budget : budgets) {
    addBar(parts, budget, &study::BudgetCause::forward, y);
    addBar(parts, budget, &study::BudgetCause::backward, y + 1);
    names += fmt::format("{}{} {}, 'backward' {}", names.empty() ? "" : ", ",
                         plotLegend(budget.method + ", forward"), exactText(y), exactText(y + 1));
    // A mark at the method's error over both of its bars.
    totals +=
        fmt::format("set arrow from {0},{1} to {0},{2} nohead front lw 2 lc rgb ink\n",
                    exactText(100 * budget.total.value), exactText(y - 0.48), exactText(y + 1.48));
    y += 2.5;
  }
  std::string data;
  std::string plot = "plot ";
  for (std::size_t p = 0; p < parts.size(); ++p) {
    // A part that no bar has still stands in the legend.
    data +=
        plotData(fmt::format("$p{}", p),
                 parts[p].rectangles.empty() ? "NaN NaN NaN NaN NaN NaN\n" : parts[p].rectangles);
    plot += fmt::format(
        "{}$p{} using 1:2:3:4:5:6 with boxxyerror fs solid noborder lc rgb '{}' title {}",
        p > 0 ? ", \\\n  " : "", p, parts[p].colour, plotLegend(parts[p].name));
  }
  // gnuplot finds no range of its own without a rectangle.
  const bool isEmpty = std::all_of(parts.begin(), parts.end(),
                                   [](const BudgetPart& part) { return part.rectangles.empty(); });
  const int lines = static_cast<int>(parts.size()) + 4;
  return {"budget",
          "Where the error comes from",
          "Each method's error by cause, forward and backward; the tables hold the same figures",
          1000,
          std::max({320, 24 * lines, 70 + 75 * static_cast<int>(budgets.size())}),
          data + plotFrame(1, "xtics ") + "set yzeroaxis lt 1 lc rgb axis\n" +
              (isEmpty ? "set xrange [0:1]\n" : "") +
              fmt::format("set yrange [{}:-0.75]\n", exactText(y - 0.75)) + "set ytics scale 0 (" +
              names + ")\n" + totals +
              fmt::format("set xlabel 'percent of {}; black line: all of the error'\n",
                          errorWhole(isSoft)) +
              "set key outside right top Left reverse samplen 1 spacing 1.1\n" + plot + "\n",
          "budget",
          {},
          place,
          {},
          {},
          {},
          true};
}

}  // namespace gnomon::report
