#pragma once

#include "image/formats/image_library.h"

namespace gnomon {

/// What the module exports: a function of this name that gives its library, which lives as long as
/// the module.
constexpr const char* imageModuleSymbol = "gnomonImageLibrary";
using ImageModuleFunction = const ImageLibrary* (*)();

}  // namespace gnomon
