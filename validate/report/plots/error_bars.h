#pragma once

#include <span>
#include <string>

#include "study/judge/ranking.h"

namespace gnomon {

/// The value at the right end of the bars of a ranking: the largest of their errors, ends of
/// intervals and ends of the truth's uncertainty.
double errorBarScale(std::span<const RankedMethod> ranked);

/// A method's mean error as a bar, an SVG of the cell's width: false shadow, then false light;
/// round their end the truth's uncertainty as a band, and the 95 % interval as a whisker. Hidden
/// from screen readers: the row has the same figures as text. Empty without an error.
/// @param scale  error at the right end, above 0
/// @throws InternalError for a number that is not finite
std::string errorBar(const RankedMethod& method, double scale);

}  // namespace gnomon
