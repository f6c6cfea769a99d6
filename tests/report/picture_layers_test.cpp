#include "report/picture_layers.h"

#include <gtest/gtest.h>

#include <random>

#include "common/error.h"

namespace gnomon {
namespace {

constexpr int width = 37;
constexpr int height = 23;
constexpr std::size_t pixels = static_cast<std::size_t>(width) * height;

class PictureLayersTest : public testing::Test {
 protected:
  Image noise() {
    Image image{width, height, {}};
    for (std::size_t i = 0; i < 3 * pixels; ++i) {
      image.rgb.push_back(static_cast<std::uint8_t>(random_() % 256));
    }
    return image;
  }

  /// A mesh's background lies where its silhouette leaves it.
  Mask mask(const std::vector<bool>& covered) {
    Mask made{width, height, {}};
    for (std::size_t i = 0; i < pixels; ++i) {
      made.samples.push_back(!covered[i]          ? Shade::none
                             : random_() % 3 == 0 ? Shade::shadowed
                                                  : Shade::lit);
    }
    return made;
  }

  std::vector<bool> silhouette() {
    std::vector<bool> covered(pixels);
    for (std::size_t i = 0; i < pixels; ++i) covered[i] = random_() % 5 != 0;
    return covered;
  }

  /// As the shading pass draws it: white where nothing is.
  static Image shaded(const PictureLayers& mesh, const Mask& mask) {
    Image image = composed(mesh, mask);
    for (std::size_t i = 0; i < pixels; ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        if (mask.samples[i] == Shade::none) image.rgb[3 * i + c] = 255;
      }
    }
    return image;
  }

  std::mt19937 random_{7};
};

TEST_F(PictureLayersTest, ComposingGivesEveryPictureAgain) {
  const std::vector<PictureLayers> meshes = {{noise(), noise()}, {noise(), noise()}};
  const std::vector<std::vector<bool>> covered = {silhouette(), silhouette()};
  LayerBuilder builder;
  std::vector<Mask> masks;
  std::vector<Image> images;
  for (std::size_t i = 0; i < 6; ++i) {
    masks.push_back(mask(covered[i % 2]));
    images.push_back(shaded(meshes[i % 2], masks[i]));
    EXPECT_EQ(builder.add(images[i], masks[i]), i % 2);
  }
  const std::vector<PictureLayers> layers = builder.layers();
  ASSERT_EQ(layers.size(), 2U);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(composed(layers[i % 2], masks[i]).rgb, images[i].rgb) << i;
  }
}

TEST_F(PictureLayersTest, AnotherSilhouetteIsAnotherMesh) {
  const PictureLayers mesh{noise(), noise()};
  std::vector<bool> covered(pixels, true);
  const Mask all = mask(covered);
  covered[5] = false;
  Mask less = all;
  less.samples[5] = Shade::none;
  LayerBuilder builder;
  EXPECT_EQ(builder.add(composed(mesh, all), all), 0U);
  EXPECT_EQ(builder.add(composed(mesh, all), less), 1U);
}

TEST_F(PictureLayersTest, FillsWhatNoPictureShowsFromTheLeft) {
  const Image picture{3, 1, {1, 2, 3, 4, 5, 6, 7, 8, 9}};
  const Mask half{3, 1, {Shade::lit, Shade::shadowed, Shade::lit}};
  LayerBuilder builder;
  builder.add(picture, half);
  const PictureLayers layers = builder.layers().front();
  EXPECT_EQ(layers.lit.rgb, (std::vector<std::uint8_t>{1, 2, 3, 1, 2, 3, 7, 8, 9}));
  EXPECT_EQ(layers.dark.rgb, (std::vector<std::uint8_t>{0, 0, 0, 4, 5, 6, 4, 5, 6}));
}

TEST_F(PictureLayersTest, RefusesAMaskOfAnotherSize) {
  LayerBuilder builder;
  EXPECT_THROW(builder.add(noise(), Mask{1, 1, {Shade::lit}}), InternalError);
}

}  // namespace
}  // namespace gnomon
