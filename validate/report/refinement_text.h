#pragma once

#include <string>

#include "study/record.h"

namespace gnomon {

/// How the truth's step was found: "Refined until at most 0.10 % of the samples differ from the
/// level before: step 1 texel (61 440 micro-triangles), 0.5 (…, 1.24 %), …". Empty where no
/// uncertainty was asked for.
std::string refinementText(const TruthRecord& truth);

/// A step with as many digits as it needs, at most four: "0.25".
std::string stepText(double texels);

}  // namespace gnomon
