#include "relief/exr_limit.h"

#include <OpenEXR/ImfHeader.h>

namespace gnomon {

void limitExrSize() {
  Imf::Header::setMaxImageSize(largestExrSide, largestExrSide);
}

}  // namespace gnomon
