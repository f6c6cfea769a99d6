#pragma once

#include <filesystem>
#include <memory>

#include "image_files/image_format.h"
#include "image_files/image_reader.h"

namespace gnomon {

/// For the module alone: as ImageLibrary::open.
std::unique_ptr<ImageReader> openImageFile(const std::filesystem::path& path, ImageFormat format);

}  // namespace gnomon
