#pragma once

#include <vector>

#include "image/image.h"

namespace gnomon::report {

/// The picture of the displaced surface by its own rays, shaded as the base mesh is, so that both
/// can be held side by side; background white.
/// @param light  as displacedPicture gives it, one a pixel, row 0 at the top
image::Image displacedImage(int width, int height, const std::vector<float>& light);

}  // namespace gnomon::report
