#pragma once

#include <optional>

#include "report/plots/plot_sheet.h"
#include "report/plots/sweep_slices.h"
#include "study/record/sweep_record.h"

namespace gnomon::report {

/// The most lights that a plot tells apart.
constexpr std::size_t mostPlottedLights = 14;

/// A slice of a sweep light by light: a panel a method, with its mean error rate over views against
/// the swept value, one curve a light, and its 95 % intervals as bars. Each panel has a scale of
/// its own, and the truth's uncertainty as a grey band. None of a study with one light, with more
/// than mostPlottedLights, or whose every light is at one value alone, since the sweep changes it.
/// @throws InternalError for a number that is not finite
std::optional<PlotSheet> sweepLightsPlot(const study::SweepRecord& sweep, const SweepSlice& slice,
                                         PlotPlace place = PlotPlace::paper);

}  // namespace gnomon::report
