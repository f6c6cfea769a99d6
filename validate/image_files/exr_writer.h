#pragma once

#include <filesystem>
#include <memory>

#include "image_files/image_writer.h"

namespace gnomon {

/// For the module alone: as ImageLibrary::createExr.
std::unique_ptr<ImageWriter> createExrFile(const std::filesystem::path& path,
                                           const ExrDescription& description);

}  // namespace gnomon
