#pragma once

#include "image/image.h"
#include "image/images.h"
#include "truth/shadow_tracer.h"

namespace gnomon::report {

/// The colour of a region in a picture of regions. Exact, so that the picture can be read back.
image::Rgb regionColour(truth::Region region);

/// In which region each sample of a truth lies, by its colour; its place among the colours is the
/// region's number.
image::PaletteImage regionImage(const truth::Truth& truth);

}  // namespace gnomon::report
