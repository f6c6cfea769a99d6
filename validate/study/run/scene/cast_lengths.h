#pragma once

#include <span>
#include <vector>

#include "common/mask.h"
#include "common/visibility.h"
#include "compare/rates.h"
#include "compare/shadow_length.h"
#include "truth/shadow_tracer.h"

namespace gnomon::study {

/// Lengths of a mask's shadows over the truth's, of those alone that an occluder casts (regions
/// `cast`, `distant` and `global`): an attached shadow has no end to measure.
/// @throws InputError as `compareShadowLengths`
compare::ShadowLengths castLengths(const Mask& mask, const truth::Truth& truth,
                                   const compare::LightField& field);

/// The same of several masks at once. @returns one a mask
std::vector<compare::ShadowLengths> castLengths(std::span<const Mask* const> masks,
                                                const truth::Truth& truth,
                                                const compare::LightField& field);

/// All metrics of two maps of visibility: `shareMetrics`, then `penumbraMetrics`.
std::vector<compare::Metric> sharesMetrics(const Visibility& candidate, const Visibility& truth,
                                           std::span<const double> weights,
                                           const compare::LightField& field);

}  // namespace gnomon::study
