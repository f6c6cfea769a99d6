#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::cli {

/// Divides a list of cases into parts of about the same cost, each of neighbours: those of one
/// sweep share what does not change between them. Whole numbers alone decide, so that every machine
/// finds the same division.
///
/// Part k of N ends where the cost of all cases so far is nearest to k / N of the whole; but it has
/// at least one case while there is one, and leaves one for each later part while there are so
/// many. So no part costs more than the mean and the dearest case together.
/// @param costs  one a case, above 0; together less than 2⁶³
/// @return where each part begins, and at last the number of cases: count + 1 numbers that rise
/// @throws InternalError for a count below 1
std::vector<std::size_t> dividedByCost(std::span<const std::uint64_t> costs, int count);

}  // namespace gnomon::cli
