#pragma once

#include <OpenImageIO/imageio.h>

#include <filesystem>

#include "image/images.h"

namespace gnomon::test {

/// What a file of three channels holds, as another library reads it.
inline image::Image readImage(const std::filesystem::path& path) {
  const auto reader = OIIO::ImageInput::open(path.string());
  if (!reader) return {};
  const OIIO::ImageSpec spec = reader->spec();
  image::Image image{spec.width, spec.height, {}};
  if (spec.nchannels != 3) return image;
  image.rgb.resize(3 * spec.image_pixels());
  reader->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, image.rgb.data());
  return image;
}

}  // namespace gnomon::test
