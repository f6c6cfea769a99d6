#include "report/plots/plot_sheet.h"

#include <fmt/core.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "report/plots/gnuplot.h"

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

}  // namespace

const std::vector<PlotColour>& frameColours() {
  // Those of the lights are Okabe and Ito's: the common colour vision deficiencies keep them apart.
  static const std::vector<PlotColour> colours = {
      {"ink", "#1a1d21", "#e8eaed"},    {"axis", "#5b626b", "#a0a8b2"},
      {"grid", "#dde1e6", "#31363d"},   {"band", "#c8c8c8", "#454b53"},
      {"light0", "#0072B2", "#3f9fdc"}, {"light1", "#D55E00", "#ef7a1d"},
      {"light2", "#009E73", "#1fc597"}, {"light3", "#CC79A7", "#e29ac2"},
      {"light4", "#56B4E9", "#8fd0f7"}, {"light5", "#E69F00", "#f2bd45"},
      {"light6", "#000000", "#ffffff"}};
  return colours;
}

std::string indexColour(std::size_t index) {
  return fmt::format("#01{:02x}{:02x}", index / 256 % 256, index % 256);
}

std::string colourSettings(const PlotSheet& sheet) {
  const bool isPage = sheet.place != PlotPlace::paper && !sheet.isShaded;
  std::string settings;
  std::size_t index = 0;
  for (const auto* colours : {&frameColours(), &sheet.colours}) {
    for (const PlotColour& colour : *colours) {
      settings +=
          fmt::format("{} = '{}'\n", colour.variable, isPage ? indexColour(index) : colour.onWhite);
      ++index;
    }
  }
  return settings;
}

std::vector<std::string> svgsOf(const std::vector<PlotSheet>& sheets) {
  // The last colour of one SVG reaches into the next: let it be the same before each.
  const std::string before =
      "set terminal svg noenhanced background '#ffffff'\nset output '/dev/null'\n"
      "unset border\nunset tics\nunset key\nplot [0:1] [0:1] 2 lc rgb 'black'\nunset output\n";
  std::vector<std::string> scripts;
  for (const PlotSheet& sheet : sheets) {
    const std::string terminal = fmt::format(
        "set terminal svg size {},{} noenhanced font 'sans-serif,{}' background '#ffffff'\n",
        sheet.width, sheet.height, sheet.place == PlotPlace::phone ? 13 : 14);
    scripts.push_back(encoding + terminal + colourSettings(sheet) + sheet.commands);
  }
  std::vector<std::string> svgs = drawByGnuplot(scripts, {before});
  for (std::size_t i = 0; i < svgs.size(); ++i) svgs[i] = cleanSvg(svgs[i], sheets[i].title);
  return svgs;
}

std::string svgOf(const PlotSheet& sheet) {
  return std::move(svgsOf({sheet}).front());
}

std::vector<std::string> pdfsOf(const std::vector<PlotSheet>& sheets) {
  constexpr double pixelsPerInch = 144;
  // gnuplot drops what is left of a point: half a thousandth keeps the last one.
  const auto inches = [](int pixels) { return pixels / pixelsPerInch + 0.0005; };
  std::vector<std::string> scripts;
  for (const PlotSheet& sheet : sheets) {
    const std::string terminal = fmt::format(
        "set terminal pdfcairo size {:.3f}in,{:.3f}in noenhanced font 'sans-serif,14' "
        "fontscale 0.4 linewidth 0.5\n",
        inches(sheet.width), inches(sheet.height));
    scripts.push_back(encoding + terminal + colourSettings(sheet) + sheet.commands);
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

}  // namespace gnomon::report
