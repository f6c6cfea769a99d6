#include "report/plots/budget_plot.h"

#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <vector>

#include "report/plots/budget_bars.h"
#include "report/plots/plot_style.h"
#include "report/text/number_text.h"

namespace gnomon {
namespace {

/// The rectangles of one part in all bars, one bar a unit of y, the first on top.
std::string partData(std::span<const BudgetRecord> budgets, const std::vector<BudgetPart>& parts,
                     std::size_t part) {
  std::string rows;
  double y = 0;
  for (const BudgetRecord& budget : budgets) {
    for (const auto way : {&BudgetCause::forward, &BudgetCause::backward}) {
      for (const BudgetBox& box : budgetBoxes(budget, parts, way)) {
        if (box.part != part || !(box.from < box.to)) continue;
        rows += fmt::format("{} {} {} {} {} {}\n", exactText(50 * (box.from + box.to)),
                            exactText(y), exactText(100 * box.from), exactText(100 * box.to),
                            exactText(y - 0.4), exactText(y + 0.4));
      }
      y += 1;
    }
    y += 0.5;
  }
  // A part that no bar has still stands in the legend.
  return rows.empty() ? "NaN NaN NaN NaN NaN NaN\n" : rows;
}

std::string barNames(std::span<const BudgetRecord> budgets) {
  std::string names;
  double y = 0;
  for (const BudgetRecord& budget : budgets) {
    names += fmt::format("{}{} {}, 'backward' {}", names.empty() ? "" : ", ",
                         plotLegend(budget.method + ", forward"), exactText(y), exactText(y + 1));
    y += 2.5;
  }
  return "set ytics scale 0 (" + names + ")\n";
}

/// A mark at the method's error over both of its bars.
std::string totals(std::span<const BudgetRecord> budgets) {
  std::string commands;
  double y = 0;
  for (const BudgetRecord& budget : budgets) {
    const std::string total = exactText(100 * budget.total.value);
    commands +=
        fmt::format("set arrow from {0},{1} to {0},{2} nohead front lw 2 lc rgb '#000000'\n", total,
                    exactText(y - 0.48), exactText(y + 1.48));
    y += 2.5;
  }
  return commands;
}

}  // namespace

PlotSheet budgetPlot(std::span<const BudgetRecord> budgets) {
  const std::vector<BudgetPart> parts = budgetParts(budgets);
  std::string data;
  std::string plot = "plot ";
  for (std::size_t p = 0; p < parts.size(); ++p) {
    data += fmt::format("$p{} << EOD\n{}EOD\n", p, partData(budgets, parts, p));
    plot += fmt::format(
        "{}$p{} using 1:2:3:4:5:6 with boxxyerror fs solid noborder lc rgb '{}' title {}",
        p > 0 ? ", \\\n  " : "", p, parts[p].colour, plotLegend(parts[p].name));
  }
  const auto bars = static_cast<double>(budgets.size());
  const int lines = static_cast<int>(parts.size()) + 4;
  return {"budget",
          "Where the error comes from",
          "Each method's error by cause, forward and backward",
          1000,
          std::max({320, 24 * lines, 70 + 75 * static_cast<int>(budgets.size())}),
          data +
              "set border 1 lc rgb '#5b626b'\n"
              "set tics nomirror out textcolor rgb '#1a1d21'\n"
              "set grid xtics lc rgb '#dde1e6' lw 1 dt 1\n"
              "set yzeroaxis lt 1 lc rgb '#5b626b'\n" +
              fmt::format("set yrange [{}:-0.75]\n", exactText(2.5 * bars - 0.75)) +
              barNames(budgets) + totals(budgets) +
              "set xlabel 'percent of the samples; black line: all of the error'\n"
              "set key outside right top Left reverse samplen 1 spacing 1.1\n" +
              plot + "\n"};
}

}  // namespace gnomon
