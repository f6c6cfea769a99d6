#include "report/plots/drawn_plots.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "cache/cache.h"
#include "common/parallel.h"
#include "report/plots/gnuplot.h"
#include "report/plots/line_plot.h"

namespace gnomon::report {
namespace {

constexpr const char* encoding = "set encoding utf8\n";
constexpr std::string_view dateKey = "/CreationDate (D:";

bool showsDate(const std::string& pdf) {
  return pdf.find(dateKey) != std::string::npos;
}

/// A PDF says when it was made: it shall not. Nothing else in it moves.
std::string withoutDate(std::string pdf) {
  const std::size_t at = pdf.rfind(dateKey);
  if (at == std::string::npos) return pdf;
  const std::string never = "19700101000000";
  return pdf.replace(at + dateKey.size(), never.size(), never);
}

struct PlotFormat {
  std::string_view name;
  std::vector<std::string> (*write)(const std::vector<PlotSheet>&);
  std::size_t plotsAtOnce;
};

// So few that other cores have some, so many that most are spared a start.
constexpr std::array<PlotFormat, 2> formats = {{{"svg", svgsOf, 24}, {"pdf", pdfsOf, 8}}};

/// Fonts are the one thing that it does not hold: they are the system's, and change no figure.
cache::ContentKey keyOf(const PlotSheet& sheet, std::string_view format) {
  cache::KeyBuilder key("drawn plot");
  key.add("format", format).add("gnuplot", gnuplotVersion()).add("title", sheet.title);
  key.add("width", sheet.width).add("height", sheet.height).add("style", darkStyle());
  return key.add("commands", sheet.commands).key();
}

/// Plots in one format, drawn where the cache does not have them.
std::vector<std::string> inFormat(const std::vector<PlotSheet>& sheets, const PlotFormat& format,
                                  cache::Cache* cache) {
  std::vector<std::string> drawn(sheets.size());
  std::vector<std::size_t> missing;
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    std::optional<std::string> kept;
    if (cache != nullptr) {
      kept = cache->find<std::string>(keyOf(sheets[i], format.name), cache::HoldsOn::thisProcessor,
                                      cache::Counted::no);
    }
    if (kept) drawn[i] = std::move(*kept);
    if (!kept) missing.push_back(i);
  }
  const std::size_t parts = (missing.size() + format.plotsAtOnce - 1) / format.plotsAtOnce;
  parallelFor(0, parts, [&](std::size_t part) {
    const auto rest = std::span(missing).subspan(part * format.plotsAtOnce);
    const auto own = rest.first(std::min(format.plotsAtOnce, rest.size()));
    std::vector<PlotSheet> wanted;
    for (const std::size_t i : own) wanted.push_back(sheets[i]);
    std::vector<std::string> made = format.write(wanted);
    for (std::size_t k = 0; k < own.size(); ++k) {
      if (cache != nullptr) cache->keep(keyOf(sheets[own[k]], format.name), made[k]);
      drawn[own[k]] = std::move(made[k]);
    }
  });
  return drawn;
}

}  // namespace

std::vector<std::string> svgsOf(const std::vector<PlotSheet>& sheets) {
  // The last colour of one SVG reaches into the next: let it be the same before each.
  const std::string before =
      "set terminal svg noenhanced background '#ffffff'\nset output '/dev/null'\n"
      "unset border\nunset tics\nunset key\nplot [0:1] [0:1] 2 lc rgb 'black'\nunset output\n";
  std::vector<std::string> scripts;
  for (const PlotSheet& sheet : sheets) {
    scripts.push_back(fmt::format(
        "{}set terminal svg size {},{} noenhanced font 'sans-serif,14' background '#ffffff'\n{}",
        encoding, sheet.width, sheet.height, sheet.commands));
  }
  std::vector<std::string> svgs = drawByGnuplot(scripts, {before});
  for (std::size_t i = 0; i < svgs.size(); ++i) {
    svgs[i] = styledSvg(svgs[i], sheets[i].title, darkStyle());
  }
  return svgs;
}

std::vector<std::string> pdfsOf(const std::vector<PlotSheet>& sheets) {
  constexpr double pixelsPerInch = 144;
  // gnuplot drops what is left of a point: half a thousandth keeps the last one.
  const auto inches = [](int pixels) { return pixels / pixelsPerInch + 0.0005; };
  std::vector<std::string> scripts;
  for (const PlotSheet& sheet : sheets) {
    scripts.push_back(
        fmt::format("{}set terminal pdfcairo size {:.3f}in,{:.3f}in noenhanced font "
                    "'sans-serif,14' fontscale 0.4 linewidth 0.5\n{}",
                    encoding, inches(sheet.width), inches(sheet.height), sheet.commands));
  }
  return undatedPdfs(scripts);
}

std::vector<std::string> undatedPdfs(const std::vector<std::string>& scripts) {
  std::vector<std::string> pdfs = drawByGnuplot(scripts);
  // cairo 1.18 compresses the date too.
  if (!std::all_of(pdfs.begin(), pdfs.end(), showsDate)) {
    pdfs = drawByGnuplot(scripts, {{}, PdfObjects::plain});
  }
  for (std::string& pdf : pdfs) pdf = withoutDate(std::move(pdf));
  return pdfs;
}

std::vector<DrawnPlot> drawPlots(std::vector<PlotSheet> sheets, cache::Cache* cache) {
  std::array<std::vector<std::string>, formats.size()> drawn;
  parallelFor(0, drawn.size(),
              [&](std::size_t i) { drawn.at(i) = inFormat(sheets, formats.at(i), cache); });
  std::vector<DrawnPlot> plots;
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    plots.push_back({std::move(sheets[i]), std::move(drawn[0][i]), std::move(drawn[1][i])});
  }
  return plots;
}

}  // namespace gnomon::report
