#pragma once

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::test {

/// A picture for a test to write: values of a pixel beside each other, rows from the top.
struct TestPicture {
  int width = 0;
  int height = 0;
  std::vector<std::string> channels = {"Y"};
  std::vector<float> values;
  OIIO::TypeDesc type = OIIO::TypeDesc::FLOAT;

  [[nodiscard]] OIIO::ImageSpec spec() const {
    OIIO::ImageSpec spec(width, height, static_cast<int>(channels.size()), type);
    spec.channelnames = channels;
    spec.alpha_channel = spec.channelindex("A");
    return spec;
  }
};

/// Writes values as the format stores them; the format is the name's.
inline void writePicture(const std::filesystem::path& path, const OIIO::ImageSpec& spec,
                         const std::vector<float>& values) {
  const auto out = OIIO::ImageOutput::create(path.string());
  ASSERT_TRUE(out) << OIIO::geterror();
  ASSERT_TRUE(out->open(path.string(), spec)) << out->geterror();
  ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, values.data())) << out->geterror();
  ASSERT_TRUE(out->close()) << out->geterror();
}

inline void writePicture(const std::filesystem::path& path, const TestPicture& picture) {
  writePicture(path, picture.spec(), picture.values);
}

}  // namespace gnomon::test
