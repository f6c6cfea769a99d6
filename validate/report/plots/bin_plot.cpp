#include "report/plots/bin_plot.h"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "common/lists.h"
#include "compare/rates.h"
#include "report/plots/plot_style.h"
#include "report/text/number_text.h"
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

/// What stands between two bins: the edge that they share, or where a bin without samples was left
/// out both of its edges.
std::string edgeText(const Ends& left, const Ends& right) {
  std::string edge = left.second ? exactText(*left.second) : "";
  if (left.second == right.first) return edge;
  return edge + "…" + (right.first ? exactText(*right.first) : "");
}

/// Ticks at the edges between the bins, and over each bin its share of the samples.
std::string ticks(const std::vector<const study::BinRecord*>& bins, const std::vector<Ends>& ends,
                  const std::string& method) {
  const auto samplesIn = [&](const Ends& bin) {
    const study::BinRecord* found = findBin(bins, method, bin);
    return found == nullptr ? 0 : static_cast<double>(found->counts.samples);
  };
  double all = 0;
  for (const Ends& bin : ends) all += samplesIn(bin);
  std::string edges;
  std::string shares;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (i > 0) {
      edges +=
          fmt::format("{}{} {}", i > 1 ? ", " : "", gnuplotText(edgeText(ends[i - 1], ends[i])),
                      exactText(static_cast<double>(i) - 0.5));
    }
    shares += fmt::format("{}'{:.1f} %%' {}", i > 0 ? ", " : "",
                          all > 0 ? 100 * samplesIn(ends[i]) / all : 0, i);
  }
  return fmt::format("set xtics ({})\nset x2tics ({})\n", edges, shares);
}

std::string lineData(const std::vector<const study::BinRecord*>& bins,
                     const std::vector<Ends>& ends, const std::string& method) {
  std::string rows;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const study::BinRecord* bin = findBin(bins, method, ends[i]);
    const auto error =
        bin == nullptr ? std::nullopt : compare::rate(bin->counts, "error_rate").value;
    rows += fmt::format("{} {}\n", i, error ? exactText(100 * *error) : "NaN");
  }
  return rows;
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
  return views;
}

PlotSheet binPlot(const study::StudyRecord& record, std::string_view axis, std::string_view view,
                  const MethodStyles& styles) {
  const std::vector<const study::BinRecord*> bins = binsOf(record, axis, view);
  const std::vector<Ends> ends = endsOf(bins);
  std::vector<std::string> methods;
  for (const study::BinRecord* bin : bins) appendOnce(methods, bin->method);
  const std::string uncertainty = exactText(100 * uncertaintyIn(record, view));
  std::string data =
      plotData("$truth", fmt::format("-0.5 {0}\n{1} {0}\n", uncertainty,
                                     exactText(static_cast<double>(ends.size()) - 0.5)));
  std::string plot =
      "plot $truth using 1:2 with filledcurves y1=0 fc rgb band title 'uncertainty of the "
      "truth'";
  std::vector<LegendEntry> legend;
  const std::vector<std::string> drawn = styles.drawnOrder(methods);
  for (std::size_t m = 0; m < drawn.size(); ++m) {
    data += plotData(fmt::format("$m{}", m), lineData(bins, ends, drawn[m]));
    plot +=
        fmt::format(", \\\n  $m{} using 1:2 with linespoints {} notitle", m, styles.line(drawn[m]));
    legend.push_back({methods[m], methods[m]});
  }
  plot += styles.legend(legend, "linespoints", &MethodStyles::line);
  const std::string title = axisTitle(axis);
  return {fmt::format("error-by-{}", axis),
          fmt::format("Error by {} ({})", title, view),
          fmt::format("Error rate of each method by {}, view {}", title, view),
          1000,
          std::max(560, 25 * (static_cast<int>(methods.size()) + 4)),
          data + plotFrame(3, "ytics ") +
              "set lmargin at screen 0.075\nset rmargin at screen 0.69\n"
              "set tmargin at screen 0.88\n" +
              ticks(bins, ends, methods.empty() ? "" : methods.front()) +
              fmt::format("set xrange [-0.5:{0}]\nset x2range [-0.5:{0}]\nset yrange [0:*]\n",
                          exactText(static_cast<double>(ends.size()) - 0.5)) +
              "set xtics font ',11'\n"
              "set x2tics font ',9' scale 0 offset 0,-0.4\n"
              "set xlabel " +
              gnuplotText(title) +
              "\n"
              "set x2label 'share of the samples' font ',10' offset 0,-0.5\n"
              "set ylabel 'error rate, percent of the bin’s samples' offset 1,0\n"
              "set key at screen 0.7, screen 0.96 left top Left reverse samplen 2 spacing 1.1 "
              "maxcols 1\n" +
              plot + "\n",
          "plots",
          styles.colours()};
}

}  // namespace gnomon::report
