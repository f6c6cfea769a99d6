#include <gtest/gtest.h>

#include "common/error.h"
#include "common/files/atomic_file.h"
#include "image/image_file.h"
#include "support/image_files.h"
#include "support/temporary_folder.h"

namespace gnomon::image {
namespace {

class Tiffs : public TemporaryFolder {
 protected:
  static constexpr int side_ = 64;

  /// Writes a deflated TIFF of 8 bits that are noise, which does not shrink.
  [[nodiscard]] std::string deflated(int tileSide) const {
    test::TestPicture picture;
    picture.width = picture.height = side_;
    picture.type = OIIO::TypeDesc::UINT8;
    for (int i = 0; i < side_ * side_; ++i) {
      picture.values.push_back(static_cast<float>((i * 7919) % 251) / 255);
    }
    OIIO::ImageSpec spec = picture.spec();
    spec.attribute("compression", "zip");
    spec.tile_width = spec.tile_height = tileSide;
    test::writePicture(path(), spec, picture.values);
    return readFile(path());
  }
  /// The same file, whose header says that a number has 16 bits.
  static std::string withTwiceTheBits(std::string tiff) {
    const std::string bitsPerSample("\x02\x01\x03\x00\x01\x00\x00\x00\x08", 9);
    const std::size_t found = tiff.find(bitsPerSample);
    EXPECT_NE(found, std::string::npos);
    tiff.at(found + bitsPerSample.size() - 1) = '\x10';
    return tiff;
  }
  void read() const {
    ImageFile image(path());
    image.requireReadable(0);
    std::vector<float> values(static_cast<std::size_t>(side_) * side_);
    image.readRows(side_, 0, 1, NumberType::float32, values.data());
  }
  [[nodiscard]] std::filesystem::path path() const { return file("map.tif"); }
};

TEST_F(Tiffs, WhoseStripsHoldLessThanTheirRowsAreRefused) {
  for (const int tileSide : {0, 16}) {
    const std::string whole = deflated(tileSide);
    EXPECT_NO_THROW(read());
    writeTextAtomically(path(), withTwiceTheBits(whole));
    EXPECT_THROW(read(), InputError) << "heights that no file holds, tiles of " << tileSide;
  }
}

}  // namespace
}  // namespace gnomon::image
