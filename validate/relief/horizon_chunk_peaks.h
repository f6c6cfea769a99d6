#pragma once

#include <cstddef>

#include "relief/azimuth_plan.h"
#include "relief/horizon_chunk.h"

namespace gnomon {

// Slopes between crossings, in double. Along a ray the height inside one cell is A + B r + C r²;
// its slope from h0, (A - h0) / r + B + C r, has a peak at r = √((A - h0) / C) if both A - h0 and C
// are negative.

/// Takes the peaks that `chunk.peaks` marks for texels [begin, end) of the chunk.
void takeMarkedPeaks(const PaddedMap& map, const AzimuthPlan& plan, const TapGroup& group,
                     std::size_t begin, std::size_t end, HorizonChunk& chunk);

/// Takes the end of the ray inside its last cell, r = D, and a peak before it, for texels
/// [begin, end) of the chunk.
void takeLastCell(const PaddedMap& map, const AzimuthPlan& plan, std::size_t begin, std::size_t end,
                  HorizonChunk& chunk);

}  // namespace gnomon
