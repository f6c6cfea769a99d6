#pragma once

#include <filesystem>
#include <memory>

#include "image/image_format.h"
#include "image/formats/image_reader.h"

namespace gnomon {

/// For the module alone: as ImageLibrary::open.
std::unique_ptr<ImageReader> openImageFile(const std::filesystem::path& path, ImageFormat format);

}  // namespace gnomon
