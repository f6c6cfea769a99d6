#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "study/judge/ranking.h"
#include "study/judge/suite/suite_statistics.h"

namespace gnomon::report {

/// Bump mapping alone: the method that every other must beat.
constexpr std::string_view controlMethod = "unshadowed";

/// The label of the method of that name; of several the one without a label of its own.
std::optional<std::string> labelOf(std::span<const study::MethodMeans> methods,
                                   std::string_view name);

/// The first method that a claim is about and that is neither `costReference` nor the control.
std::optional<std::string> claimedMethod(std::span<const study::MethodMeans> methods,
                                         std::span<const study::ClaimRecord> claims);

/// The most methods that a plot shows.
constexpr std::size_t mostPlotted = 8;

/// The methods that plots show and of which a page shows the worst places, in the order of the
/// ranking: the flat horizon map (`costReference`), the method that the first claim is about, and
/// the first of the ranking, `mostPlotted` in all; of a method with several entries the best one,
/// and more where there is room.
/// @param study   of a run or a sweep
/// @param chosen  labels that are shown instead, in their order, where the study has any of them
std::vector<std::string> plottedMethods(const study::StudyMeans& study,
                                        const std::vector<std::string>& chosen = {});

/// Likewise of a suite, whose ranking is over its scenes and which claims nothing.
std::vector<std::string> plottedMethods(const study::SuiteStatistics& statistics,
                                        const std::vector<std::string>& chosen = {});

}  // namespace gnomon::report
