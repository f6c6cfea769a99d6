#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "image/formats/image_writer.h"

namespace gnomon {

/// For the module alone: as ImageLibrary::createExr.
std::unique_ptr<ImageWriter> createExrFile(const std::filesystem::path& path,
                                           const ExrDescription& description);

/// For the module alone: as ImageLibrary::exrBytes.
std::string exrFileBytes(const ExrDescription& description, const std::vector<float>& values);

}  // namespace gnomon
