#pragma once

#include <vector>

#include "image/images.h"
#include "truth/shadow_tracer.h"

namespace gnomon::report {

/// The picture of the displaced surface by its own rays, shaded as the base mesh is, so that both
/// can be held side by side; background white.
/// @param light  as displacedPicture gives it, one a pixel, row 0 at the top
image::Image displacedImage(int width, int height, const std::vector<float>& light);

/// The colour of a region in a picture of regions. Exact, so that the picture can be read back.
image::Rgb regionColour(truth::Region region);

/// In which region each sample of a truth lies, by its colour; its place among the colours is the
/// region's number.
image::PaletteImage regionImage(const truth::Truth& truth);

}  // namespace gnomon::report
