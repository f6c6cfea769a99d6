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

namespace gnomon::report {
namespace {

/// Fonts are the one thing that it does not hold: they are the system's, and change no figure.
cache::ContentKey keyOf(const PlotSheet& sheet, std::string_view format) {
  cache::KeyBuilder key("drawn plot");
  key.add("format", format).add("gnuplot", gnuplotVersion()).add("title", sheet.title);
  key.add("width", sheet.width).add("height", sheet.height);
  key.add("place", static_cast<int>(sheet.place)).add("shaded", sheet.isShaded ? 1 : 0);
  for (const PlotColour& colour : sheet.colours) key.add(colour.variable, colour.onWhite);
  return key.add("commands", sheet.commands).key();
}

struct PlotFormat {
  std::string_view name;
  std::vector<std::string> (*write)(const std::vector<PlotSheet>&);
  std::size_t plotsAtOnce;
};

// So few that other cores have some, so many that most are spared a start.
constexpr PlotFormat svgFormat = {"svg", svgsOf, 24};
constexpr PlotFormat pdfFormat = {"pdf", pdfsOf, 8};

/// One plot in one format.
struct Drawing {
  const PlotSheet* sheet;
  std::optional<cache::ContentKey> key = {};
  std::string bytes = {};
};

/// Draws some, and keeps them.
void draw(std::span<Drawing* const> wanted, const PlotFormat& format, cache::Cache* cache) {
  std::vector<PlotSheet> sheets;
  for (const Drawing* drawing : wanted) sheets.push_back(*drawing->sheet);
  std::vector<std::string> drawn = format.write(sheets);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    wanted[i]->bytes = std::move(drawn[i]);
    if (cache != nullptr) cache->keep(*wanted[i]->key, wanted[i]->bytes);
  }
}

/// Plots in one format, drawn where the cache does not have them.
std::vector<std::string> inFormat(std::span<const PlotSheet> sheets, const PlotFormat& format,
                                  cache::Cache* cache) {
  std::vector<Drawing> all;
  all.reserve(sheets.size());
  std::vector<Drawing*> missing;
  for (const PlotSheet& sheet : sheets) {
    Drawing& drawing = all.emplace_back(Drawing{&sheet});
    std::optional<std::string> kept;
    if (cache != nullptr) {
      drawing.key = keyOf(sheet, format.name);
      kept =
          cache->find<std::string>(*drawing.key, cache::HoldsOn::thisProcessor, cache::Counted::no);
    }
    if (kept) drawing.bytes = std::move(*kept);
    if (!kept) missing.push_back(&drawing);
  }
  const std::size_t parts = (missing.size() + format.plotsAtOnce - 1) / format.plotsAtOnce;
  parallelFor(0, parts, [&](std::size_t part) {
    const auto rest = std::span(missing).subspan(part * format.plotsAtOnce);
    draw(rest.first(std::min(format.plotsAtOnce, rest.size())), format, cache);
  });
  std::vector<std::string> drawn;
  drawn.reserve(all.size());
  for (Drawing& drawing : all) drawn.push_back(std::move(drawing.bytes));
  return drawn;
}

}  // namespace

DrawnPlots drawPlots(const std::function<std::vector<PlotSheet>(PlotPlace)>& sheetsFor,
                     cache::Cache* cache) {
  std::vector<PlotSheet> sheets = sheetsFor(PlotPlace::paper);
  const std::size_t count = sheets.size();
  for (const PlotPlace place : {PlotPlace::page, PlotPlace::phone}) {
    for (PlotSheet& sheet : sheetsFor(place)) sheets.push_back(std::move(sheet));
  }
  std::array<std::vector<std::string>, 2> drawn;  // SVGs and PDFs
  parallelFor(0, drawn.size(), [&](std::size_t i) {
    drawn.at(i) = i == 0 ? inFormat(sheets, svgFormat, cache)
                         : inFormat(std::span(sheets).first(count), pdfFormat, cache);
  });
  std::vector<std::string>& svgs = drawn[0];
  DrawnPlots plots;
  for (std::size_t i = 0; i < count; ++i) {
    PlotSheet& wide = sheets[count + i];
    PlotSheet& narrow = sheets[2 * count + i];
    plots.paper.push_back({fmt::format("plots/{}.svg", wide.name), std::move(svgs[i])});
    plots.paper.push_back({fmt::format("plots/{}.pdf", wide.name), std::move(drawn[1][i])});
    const bool hasNarrow = narrow.width != wide.width;
    plots.page.push_back({std::move(wide), std::move(svgs[count + i])});
    if (!hasNarrow) continue;
    plots.page.back().narrow = std::move(narrow);
    plots.page.back().narrowSvg = std::move(svgs[2 * count + i]);
  }
  return plots;
}

}  // namespace gnomon::report
