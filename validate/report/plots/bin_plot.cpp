#include "report/plots/bin_plot.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "common/lists.h"
#include "compare/rates.h"
#include "report/plots/plot_style.h"
#include "report/text/interval_text.h"
#include "report/text/number_text.h"
#include "study/judge/study_means.h"
#include "study/record/cases.h"
#include "study/record/confidence_record.h"
#include "study/run/scene/sample_axes.h"

namespace gnomon::report {
namespace {

using Ends = std::pair<std::optional<double>, std::optional<double>>;

/// The bins of one axis and view, all lights together.
std::vector<const study::BinRecord*> binsOf(const study::StudyRecord& record, std::string_view axis,
                                            std::string_view view) {
  std::vector<const study::BinRecord*> bins;
  for (const study::BinRecord& bin : record.bins) {
    if (bin.axis == axis && bin.view == view && bin.light == study::allLights) bins.push_back(&bin);
  }
  return bins;
}

/// All bins that any method has, rising; the one without a lower end first.
std::vector<Ends> endsOf(const std::vector<const study::BinRecord*>& bins) {
  std::vector<Ends> ends;
  ends.reserve(bins.size());
  for (const study::BinRecord* bin : bins) ends.emplace_back(bin->low, bin->high);
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  return ends;
}

const study::BinRecord* findBin(const std::vector<const study::BinRecord*>& bins,
                                const std::string& method, const Ends& ends) {
  const auto found = std::find_if(bins.begin(), bins.end(), [&](const study::BinRecord* bin) {
    return bin->method == method && Ends{bin->low, bin->high} == ends;
  });
  return found == bins.end() ? nullptr : *found;
}

/// None where the method has no sample in the bin.
std::optional<double> errorIn(const std::vector<const study::BinRecord*>& bins,
                              const std::string& method, const Ends& ends) {
  const study::BinRecord* bin = findBin(bins, method, ends);
  return bin == nullptr ? std::nullopt
                        : compare::rate(bin->counts, compare::metrics::errorRate).value;
}

/// Where a bin lies on the axis. An open bin is drawn as wide as its neighbour.
struct Place {
  double low, high, middle;
};

/// The bins as an axis has them: with their true widths, of edges that grow by one factor on a
/// logarithmic axis.
struct BinAxis {
  std::vector<Place> places;
  bool isLogarithmic = false;

  [[nodiscard]] double left() const { return places.front().low; }
  [[nodiscard]] double right() const { return places.back().high; }
  /// How far across the axis a value lies, 0 to 1.
  [[nodiscard]] double share(double value) const {
    const auto scale = [&](double v) { return isLogarithmic ? std::log(v) : v; };
    return (scale(value) - scale(left())) / (scale(right()) - scale(left()));
  }
};

BinAxis axisOf(const std::vector<Ends>& ends) {
  std::vector<double> edges;
  for (const auto& [low, high] : ends) {
    for (const auto& edge : {low, high}) {
      if (edge) edges.push_back(*edge);
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  BinAxis axis;
  axis.isLogarithmic = isGeometric(edges);
  const auto beyond = [&](double edge, double next) {
    return axis.isLogarithmic ? edge * edge / next : 2 * edge - next;
  };
  // One edge alone has no neighbour, none has not even a place.
  const double single = edges.empty() ? 0.5 : edges.front();
  const double left = edges.size() > 1 ? beyond(edges[0], edges[1]) : single - 1;
  const double right =
      edges.size() > 1 ? beyond(edges[edges.size() - 1], edges[edges.size() - 2]) : single + 1;
  for (const auto& [low, high] : ends) {
    Place place{low.value_or(left), high.value_or(right), 0};
    place.middle =
        axis.isLogarithmic ? std::sqrt(place.low * place.high) : (place.low + place.high) / 2;
    axis.places.push_back(place);
  }
  return axis;
}

/// Labels at places of an axis, as far as each has its room, a share of the axis.
std::string ticsWhereRoom(const BinAxis& axis,
                          const std::vector<std::pair<double, std::string>>& labels,
                          double roomOfCharacter) {
  std::string tics;
  double free = -1;
  for (const auto& [place, text] : labels) {
    const double half = roomOfCharacter * static_cast<double>(displayWidth(text) + 1) / 2;
    const double at = axis.share(place);
    const bool hasRoom = at - half >= free;
    tics += fmt::format("{}{} {}", tics.empty() ? "" : ", ", gnuplotText(hasRoom ? text : ""),
                        exactText(place));
    if (hasRoom) free = at + half;
  }
  return tics;
}

/// Tics at the edges of the bins, those that have room on so many pixels.
std::string edgeTics(const std::vector<Ends>& ends, const BinAxis& axis, int pixels) {
  std::vector<std::pair<double, std::string>> edges;
  for (const auto& [low, high] : ends) {
    for (const auto& edge : {low, high}) {
      if (edge && (edges.empty() || edges.back().first != *edge)) {
        edges.emplace_back(*edge, exactText(*edge));
      }
    }
  }
  return "set xtics (" + ticsWhereRoom(axis, edges, 8.0 / pixels) + ")\n";
}

/// Over each bin its share of the samples, likewise.
std::string shareTics(const std::vector<const study::BinRecord*>& bins,
                      const std::vector<Ends>& ends, const BinAxis& axis, const std::string& method,
                      int pixels) {
  const auto samplesIn = [&](const Ends& bin) {
    const study::BinRecord* found = findBin(bins, method, bin);
    return found == nullptr ? 0 : static_cast<double>(found->counts.samples);
  };
  double all = 0;
  for (const Ends& bin : ends) all += samplesIn(bin);
  std::vector<std::pair<double, std::string>> shares;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    shares.emplace_back(axis.places[i].middle,
                        fmt::format("{:.1f} %%", all > 0 ? 100 * samplesIn(ends[i]) / all : 0));
  }
  return "set x2tics (" + ticsWhereRoom(axis, shares, 6.5 / pixels) + ")\n";
}

/// Middle, error, lower end, width of each bin; no row of a bin without samples, which is a gap.
std::string lineData(const std::vector<const study::BinRecord*>& bins,
                     const std::vector<Ends>& ends, const BinAxis& axis,
                     const std::string& method) {
  std::string rows;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const auto error = errorIn(bins, method, ends[i]);
    const Place& place = axis.places[i];
    rows += fmt::format("{} {} {} {}\n", exactText(place.middle),
                        error ? exactText(100 * *error) : "NaN", exactText(place.low),
                        exactText(place.high - place.low));
  }
  return rows;
}

/// The values behind the plot: a row a method, a column a bin.
Table valuesTable(const std::vector<const study::BinRecord*>& bins, const std::vector<Ends>& ends,
                  const std::vector<std::string>& methods) {
  Table table{.kind = "values", .columns = {{"Method", "", Quantity::name}}};
  for (const auto& [low, high] : ends) {
    table.columns.push_back({binText(low, high), "", Quantity::percent});
  }
  for (const std::string& method : methods) {
    Row row{{textCell(method)}};
    for (const Ends& bin : ends) row.cells.push_back(valueCell(errorIn(bins, method, bin)));
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// The truth's uncertainty in a view, mean over its lights; 0 where it was not measured.
double uncertaintyIn(const study::StudyRecord& record, std::string_view view) {
  double sum = 0;
  double lights = 0;
  for (const study::UncertaintyRecord& flip : record.truth.flips) {
    if (flip.view != view) continue;
    sum += flip.flipRate;
    ++lights;
  }
  return lights > 0 ? sum / lights : 0;
}

/// The axis's title without its unit.
std::string axisWords(std::string_view axis) {
  for (const study::SampleAxis& known : study::sampleAxes()) {
    if (known.name == axis) return std::string(known.title);
  }
  return std::string(axis);
}

}  // namespace

std::string axisTitle(std::string_view axis) {
  for (const study::SampleAxis& known : study::sampleAxes()) {
    if (known.name != axis) continue;
    return known.unit.empty() ? std::string(known.title)
                              : fmt::format("{}, {}", known.title, known.unit);
  }
  return std::string(axis);
}

std::vector<std::string> binAxes(const study::StudyRecord& record) {
  std::vector<std::string> axes;
  for (const study::BinRecord& bin : record.bins) appendOnce(axes, bin.axis);
  return axes;
}

std::vector<std::string> binViews(const study::StudyRecord& record, std::string_view axis) {
  std::vector<std::string> views;
  for (const study::BinRecord& bin : record.bins) {
    if (bin.axis == axis && bin.light == study::allLights) appendOnce(views, bin.view);
  }
  std::erase_if(views, [&](const std::string& view) {
    return endsOf(binsOf(record, axis, view)).size() < 2;
  });
  return views;
}

PlotSheet binPlot(const study::StudyRecord& record, std::string_view axis, std::string_view view,
                  const MethodStyles& styles, PlotPlace place) {
  const std::vector<const study::BinRecord*> bins = binsOf(record, axis, view);
  const std::vector<Ends> ends = endsOf(bins);
  const BinAxis places = axisOf(ends);
  std::vector<std::string> methods;
  for (const study::BinRecord* bin : bins) appendOnce(methods, bin->method);
  const std::string title = axisTitle(axis);
  const int lines = static_cast<int>(methods.size()) + 4;
  PlotSheet sheet{.name = fmt::format("error-by-{}", axis),
                  .title = fmt::format("Error by {} ({})", title, view),
                  .about = fmt::format("Error rate of each method by {}, view {}", title, view),
                  .colours = styles.colours(),
                  .place = place,
                  .table = valuesTable(bins, ends, methods)};
  PlotMargins margins{75, 310, 67, 70};
  if (place == PlotPlace::paper) {
    sheet.height = std::max(560, 25 * lines);
  } else if (place == PlotPlace::page) {
    sheet.height = 430;
    margins = {66, 12, 46, 68};
  } else {
    sheet.width = 380;
    sheet.height = 360;
    margins = {58, 8, 46, 64};
  }
  const double uncertainty = 100 * uncertaintyIn(record, view);
  std::string data = plotData(
      "$truth", fmt::format("{} {}\n{} {}\n", exactText(places.left()), exactText(uncertainty),
                            exactText(places.right()), exactText(uncertainty)));
  std::string plot = "plot " + plotBand("$truth", true);
  std::vector<LegendEntry> legend;
  ValuePoints values("$values");
  for (const std::string& method : styles.drawnOrder(methods)) {
    const auto m = static_cast<std::size_t>(std::find(methods.begin(), methods.end(), method) -
                                            methods.begin());
    data += plotData(fmt::format("$m{}", m), lineData(bins, ends, places, method));
    plot += fmt::format(
        ", \\\n  $m{} using 3:2:4:(0) with vectors nohead {} lw 2 notitle, \\\n"
        "  $m{} using 1:2 with linespoints {} notitle",
        m, styles.colour(method), m, styles.line(method));
    for (std::size_t i = 0; i < ends.size(); ++i) {
      const auto error = errorIn(bins, method, ends[i]);
      if (!error) continue;
      values.add(sheet, places.places[i].middle, 100 * *error,
                 fmt::format("{}: {} % wrong, {} {}", method, percentText(error), axisWords(axis),
                             binText(ends[i].first, ends[i].second)));
    }
    values.endCurve();
  }
  legend.reserve(legend.size() + methods.size());
  for (const std::string& method : methods) legend.push_back({method, method});
  plot += styles.legend(legend, "linespoints", &MethodStyles::line);
  sheet.legend = styles.items(legend, true);
  sheet.legend.push_back(bandItem());
  const bool isPhone = place == PlotPlace::phone;
  const int pixels = sheet.width - margins.left - margins.right;
  // Of 84 mm some 300 of these pixels are left for the axis; a row of shares has no room.
  sheet.columnCommands = "unset x2tics\nunset x2label\n" + edgeTics(ends, places, 300);
  sheet.commands =
      data + values.data(sheet) + plotFrame(3, "ytics ") +
      plotMargins(margins, sheet.width, sheet.height) +
      (places.isLogarithmic ? "set logscale x\nset logscale x2\n" : "") +
      edgeTics(ends, places, pixels) +
      shareTics(bins, ends, places, methods.empty() ? "" : methods.front(), pixels) +
      fmt::format("set xrange [{0}:{1}]\nset x2range [{0}:{1}]\nset yrange [0:*]\n",
                  exactText(places.left()), exactText(places.right())) +
      "set xtics font ',11'\n"
      "set x2tics font ',9' scale 0 offset 0,-0.4\n"
      "set xlabel " +
      gnuplotText(title) +
      " offset 0,0.5\n"
      "set x2label 'share of the samples' font ',10' offset 0,-0.5\n" +
      (isPhone
           ? "set ylabel 'wrong, percent' offset 2.2,0\n"
           : "set ylabel " + gnuplotText(binErrorAxis(study::isSoft(record))) + " offset 1,0\n") +
      (place == PlotPlace::paper
           ? "set key at screen 0.7, screen 0.96 left top Left reverse samplen 2 spacing 1.1 "
             "maxcols 1\n"
           : "unset key\n") +
      plot + values.plot(sheet) + "\n";
  return sheet;
}

}  // namespace gnomon::report
