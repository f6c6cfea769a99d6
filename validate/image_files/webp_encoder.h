#pragma once

#include <cstdint>
#include <string>

namespace gnomon {

/// For the module alone: as ImageLibrary::webp. OpenImageIO asks its encoder for the utmost effort,
/// which takes one and a half times to twice as long for pictures 1 to 3 % shorter; this is the
/// encoder itself at its usual effort.
std::string webPBytes(int width, int height, const std::uint8_t* rgb, int quality);

}  // namespace gnomon
