#include "report/plots/sweep_slices.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "report/plots/gnuplot.h"
#include "report/plots/line_plot.h"
#include "report/text/text_width.h"

namespace gnomon::report {
namespace {

/// One dimension as an axis.
struct Dimension {
  std::string axis;
  std::vector<double> positions;        ///< one a case of the sweep
  std::vector<std::string> categories;  ///< of places that are no numbers
  std::vector<std::string> texts;       ///< "bake.bits = 8", one a case

  [[nodiscard]] std::set<double> places() const { return {positions.begin(), positions.end()}; }
};

/// What a case has in the keys.
std::string textIn(const study::SweepRecord& sweep, const std::vector<std::size_t>& keys,
                   std::size_t which) {
  std::string text;
  for (const std::size_t k : keys) {
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", sweep.keys[k].key,
                        sweep.cases[which].values.at(k).text);
  }
  return text;
}

/// Whether a key's values are numbers, and tell the steps of its dimension apart.
bool tellsApart(const study::SweepRecord& sweep, std::size_t key,
                const std::vector<std::string>& steps) {
  std::set<std::pair<double, std::string>> pairs;
  std::set<double> values;
  for (std::size_t i = 0; i < sweep.cases.size(); ++i) {
    const study::SweptValue& value = sweep.cases[i].values.at(key);
    if (!value.number) return false;
    values.insert(*value.number);
    pairs.emplace(*value.number, steps[i]);
  }
  return values.size() == pairs.size();
}

std::string shortText(const std::string& text) {
  constexpr std::size_t longest = 24;
  return displayWidth(text) > longest ? fitLeft(text, longest) : text;
}

Dimension dimensionOf(const study::SweepRecord& sweep, std::size_t dimension) {
  std::vector<std::size_t> keys;
  for (std::size_t k = 0; k < sweep.keys.size(); ++k) {
    if (sweep.keys[k].dimension == dimension) keys.push_back(k);
  }
  Dimension found;
  for (std::size_t i = 0; i < sweep.cases.size(); ++i)
    found.texts.push_back(textIn(sweep, keys, i));
  const auto axisKey = std::find_if(
      keys.begin(), keys.end(), [&](std::size_t k) { return tellsApart(sweep, k, found.texts); });
  const std::size_t shown = axisKey != keys.end() ? *axisKey : keys.front();
  found.axis = sweep.keys[shown].axis;
  for (const std::size_t k : keys) {
    if (k != shown) found.axis += fmt::format(", with {}", sweep.keys[k].axis);
  }
  std::vector<std::string> seen;
  for (std::size_t i = 0; i < sweep.cases.size(); ++i) {
    const study::SweptValue& value = sweep.cases[i].values.at(shown);
    if (axisKey != keys.end()) {
      found.positions.push_back(*value.number);
      continue;
    }
    const auto at = std::find(seen.begin(), seen.end(), found.texts[i]);
    found.positions.push_back(static_cast<double>(at - seen.begin()));
    if (at != seen.end()) continue;
    seen.push_back(found.texts[i]);
    found.categories.push_back(shortText(value.text));
  }
  return found;
}

std::vector<Dimension> dimensionsOf(const study::SweepRecord& sweep) {
  std::vector<Dimension> dimensions;
  const std::size_t count = study::dimensionCount(sweep.keys);
  if (sweep.cases.empty() || count > 2) return {};
  for (std::size_t d = 0; d < count; ++d) {
    dimensions.push_back(dimensionOf(sweep, d));
  }
  return dimensions;
}

/// The cases in the order of their positions.
SweepSlice sliceOf(const Dimension& axis, std::vector<std::size_t> cases) {
  std::stable_sort(cases.begin(), cases.end(), [&](std::size_t a, std::size_t b) {
    return axis.positions[a] < axis.positions[b];
  });
  SweepSlice slice;
  slice.axis = axis.axis;
  slice.categories = axis.categories;
  for (const std::size_t i : cases) slice.positions.push_back(axis.positions[i]);
  slice.cases = std::move(cases);
  return slice;
}

}  // namespace

std::vector<SweepSlice> slicesOf(const study::SweepRecord& sweep) {
  const std::vector<Dimension> dimensions = dimensionsOf(sweep);
  if (dimensions.empty()) return {};
  std::vector<std::size_t> all(sweep.cases.size());
  std::iota(all.begin(), all.end(), 0);
  if (dimensions.size() == 1) return {sliceOf(dimensions.front(), all)};
  const bool isFirstLonger = dimensions[0].places().size() >= dimensions[1].places().size();
  const Dimension& axis = dimensions[isFirstLonger ? 0 : 1];
  const Dimension& cut = dimensions[isFirstLonger ? 1 : 0];
  const std::set<double> places = cut.places();
  if (places.size() > mostSlices) return {};
  std::vector<SweepSlice> slices;
  for (const double place : places) {
    std::vector<std::size_t> cases;
    std::copy_if(all.begin(), all.end(), std::back_inserter(cases),
                 [&](std::size_t i) { return cut.positions[i] == place; });
    const std::string title = cut.texts[cases.front()];
    slices.push_back(sliceOf(axis, std::move(cases)));
    slices.back().title = title;
    slices.back().suffix = fmt::format("_{}", slices.size());
  }
  return slices;
}

std::string axisCommands(const SweepSlice& slice) {
  if (!slice.categories.empty()) {
    constexpr std::size_t mostLabels = 9;
    const std::size_t step = (slice.categories.size() + mostLabels - 1) / mostLabels;
    std::string tics;
    for (std::size_t i = 0; i < slice.categories.size(); i += step) {
      tics += fmt::format("{}{} {}", tics.empty() ? "" : ", ", gnuplotText(slice.categories[i]), i);
    }
    return "set xtics (" + tics + ")\n";
  }
  // Up to the values, not to the next tic: a radius of 0 has nothing below it.
  return std::string("set autoscale xfix\n") +
         (isGeometric(slice.positions) ? "set logscale x\n" : "");
}

}  // namespace gnomon::report
