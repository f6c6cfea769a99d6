#include "report/plots/plot_style.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace gnomon::report {
namespace {

/// gnuplot's numbers of the shapes that render::methodSymbols names, in its order, and of outlined
/// ones, which those leave to variants.
constexpr std::array<int, render::methodSymbols.size()> symbolPoints = {7,  5, 9, 11, 13,
                                                                        15, 1, 2, 3};
constexpr std::array<int, 6> outlinedPoints = {6, 4, 8, 10, 12, 14};

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
  constexpr std::uint32_t dashes = 4;
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

}  // namespace gnomon::report
