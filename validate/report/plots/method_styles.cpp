#include "report/plots/method_styles.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>

#include "common/lists.h"
#include "report/highlights.h"
#include "report/plots/plot_style.h"

namespace gnomon::report {
namespace {

/// gnuplot's numbers of the shapes that render::methodSymbols names, in its order, and of outlined
/// ones, which those leave to variants.
constexpr std::array<int, render::methodSymbols.size()> symbolPoints = {7,  5, 9, 11, 13,
                                                                        15, 1, 2, 3};
constexpr std::array<int, 6> outlinedPoints = {6, 4, 8, 10, 12, 14};

/// Of labels that are no method of the report, whose label matches none.
const MethodStyle unknownStyle = {"own"};

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

const FamilyColours& coloursOf(const std::string& family) {
  return *std::find_if(familyColours.begin(), familyColours.end(),
                       [&](const auto& colours) { return colours.family == family; });
}

}  // namespace

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

MethodStyles::MethodStyles(const study::StudyMeans& study) : highlighted_(highlights(study)) {
  for (const study::MethodMeans& method : study.methods) {
    methods_.push_back({method.label, methodStyle(method.name, method.label, method.mark),
                        methodStyle(method.name, method.name, method.mark)});
  }
  methods_.push_back({"", unknownStyle, unknownStyle});
}

MethodStyles::MethodStyles(const study::SuiteStatistics& statistics)
    : highlighted_(highlights(statistics)) {
  for (const study::SuiteMethod& method : statistics.methods) {
    const std::string& name = method.names.empty() ? method.label : method.names.front();
    methods_.push_back({method.label, methodStyle(name, method.label, method.mark),
                        methodStyle(name, name, method.mark)});
  }
  methods_.push_back({"", unknownStyle, unknownStyle});
}

bool MethodStyles::isHighlighted(const std::string& label) const {
  return contains(highlighted_, label);
}

std::size_t MethodStyles::indexOf(const std::string& label) const {
  const auto found = std::find_if(methods_.begin(), methods_.end() - 1,
                                  [&](const Styled& method) { return method.label == label; });
  return static_cast<std::size_t>(found - methods_.begin());
}

std::string MethodStyles::variable(const std::string& label) const {
  return fmt::format("method{}", indexOf(label));
}

std::string MethodStyles::colour(const std::string& label) const {
  return "lc rgb " + variable(label);
}

std::string MethodStyles::line(const std::string& label) const {
  const MethodStyle& style = methods_.at(indexOf(label)).style;
  return fmt::format("{} pt {} ps 0.7 lw 2 dt {}", colour(label), style.point, style.dash);
}

std::string MethodStyles::stroke(const std::string& label) const {
  return fmt::format("{} lw 2 dt {}", colour(label), methods_.at(indexOf(label)).style.dash);
}

std::string MethodStyles::pointClause(const std::string& label, const MethodStyle& style) const {
  return fmt::format("{} pt {} ps 1 lw 2", colour(label), style.point);
}

std::string MethodStyles::points(const std::string& label) const {
  return pointClause(label, methods_.at(indexOf(label)).style);
}

std::string MethodStyles::pointsOfMethod(const std::string& label) const {
  return pointClause(label, methods_.at(indexOf(label)).own);
}

std::vector<PlotColour> MethodStyles::colours() const {
  std::vector<PlotColour> colours;
  for (std::size_t m = 0; m < methods_.size(); ++m) {
    const FamilyColours& found =
        isHighlighted(methods_[m].label) ? coloursOf(methods_[m].style.family) : otherMethods;
    colours.push_back({fmt::format("method{}", m), std::string(found.onWhite),
                       std::string(found.onDark), methods_[m].style.family});
  }
  return colours;
}

std::vector<std::string> MethodStyles::drawnOrder(std::vector<std::string> labels) const {
  std::stable_partition(labels.begin(), labels.end(),
                        [&](const std::string& label) { return !isHighlighted(label); });
  return labels;
}

std::string MethodStyles::legend(const std::vector<LegendEntry>& entries, const char* with,
                                 std::string (MethodStyles::*style)(const std::string&)
                                     const) const {
  std::string text;
  for (const bool wanted : {true, false}) {
    for (const LegendEntry& entry : entries) {
      if (isHighlighted(entry.label) != wanted) continue;
      text += fmt::format(", \\\n  keyentry with {} {} title {}", with, (this->*style)(entry.label),
                          plotLegend(entry.text));
    }
  }
  return text;
}

std::vector<LegendItem> MethodStyles::items(const std::vector<LegendEntry>& entries,
                                            bool hasLine) const {
  std::vector<LegendItem> items;
  for (const bool wanted : {true, false}) {
    for (const LegendEntry& entry : entries) {
      if (isHighlighted(entry.label) != wanted) continue;
      const Styled& method = methods_.at(indexOf(entry.label));
      items.push_back({.text = entry.text,
                       .variable = variable(entry.label),
                       .point = (hasLine ? method.style : method.own).point,
                       .dash = hasLine ? method.style.dash : 0,
                       .isMethod = true,
                       .isHighlighted = wanted});
    }
  }
  return items;
}

}  // namespace gnomon::report
