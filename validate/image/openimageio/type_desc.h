#pragma once

#include <OpenImageIO/typedesc.h>

#include "image/formats/number_type.h"

namespace gnomon {

/// For the module alone: OpenImageIO's name of a type.
inline OIIO::TypeDesc typeDesc(NumberType type) {
  return OIIO::TypeDesc(nameOf(type));
}

}  // namespace gnomon
