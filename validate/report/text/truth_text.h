#pragma once

#include <optional>
#include <string>

#include "study/record/record.h"

namespace gnomon::report {

/// "83 texels: a ray to the light …".
std::string radiusText(const study::RadiusRecord& radius);

/// The truth's own error, of the view and light where it is largest: in the mean, at 99.9 % of the
/// samples of a soft light, and whether coarse facets darken or brighten. Empty where it was not
/// measured.
std::string truthErrorText(const study::TruthRecord& truth);

/// A flip rate in percent with three significant digits, since it may be far below a hundredth:
/// "0.0831"; "–" for none.
std::string flipText(std::optional<double> rate);

/// A step with as many digits as it needs, at most four: "0.25".
std::string stepText(double texels);

}  // namespace gnomon::report
