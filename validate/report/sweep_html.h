#pragma once

#include <string>

#include "study/sweep_record.h"

namespace gnomon {

/// A sweep as one page that loads nothing: its plot, the error rates of methods × values shaded by
/// size, its claims and the thresholds that failed. It links to the reports of its steps, whose
/// folders lie beside it.
/// @param plot  the sweep's plot as an SVG document, embedded
/// @throws InternalError for a number that is not finite
std::string sweepHtml(const SweepRecord& sweep, const std::string& plot);

}  // namespace gnomon
