#pragma once

#include <filesystem>

#include "image_files/image_library.h"
#include "report/image.h"

namespace gnomon::test {

/// What a file of three channels holds, as another library reads it.
inline Image readImage(const std::filesystem::path& path) {
  const auto reader = imageLibrary().open(path);
  const ImageFacts facts = reader->facts();
  Image image{facts.data.width, facts.data.height, {}};
  if (facts.channelCount() != 3) return image;
  image.rgb.resize(3 * facts.pixelCount);
  reader->read(0, 3, NumberType::uint8, image.rgb.data());
  return image;
}

}  // namespace gnomon::test
