#pragma once

#include "image/image.h"
#include "image/images.h"
#include "truth/shadow_tracer.h"

namespace gnomon {

/// The colour of a region in a picture of regions. Exact, so that the picture can be read back.
Rgb regionColour(Region region);

/// In which region each sample of a truth lies.
Image regionImage(const Truth& truth);

}  // namespace gnomon
