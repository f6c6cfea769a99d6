#include <gmock/gmock.h>

#include <cmath>

#include "end_to_end/support/program.h"

// A method is one GLSL file and no C++: files of this folder run as the built-in ones do.

namespace gnomon::test {
namespace {

class OwnMethod : public EndToEnd {
 protected:
  [[nodiscard]] static std::string study(const std::string& methods) {
    return smallStudy() + methods;
  }
  [[nodiscard]] static std::string method(const std::string& file, const std::string& more = {}) {
    return "\n[[method]]\nfile = \"" GNOMON_OWN_METHODS "/" + file + ".glsl\"\n" + more;
  }
  [[nodiscard]] double error(const std::string& label, const std::string& answer = "drawn") const {
    return resultOf(summary("small"), label, "evening", "camera", "all", answer).at("error_rate");
  }
};

TEST_F(OwnMethod, RunsWithItsParameter) {
  runStudy("small",
           study(method("biased-horizon") +
                 method("biased-horizon", "label = \"dark\"\nparameters = {bias = 2.0}\n") +
                 method("biased-horizon", "label = \"light\"\nparameters = {bias = -2}\n")));
  EXPECT_EQ(error("biased-horizon"), error("max-forsyth")) << "without bias they are the same";
  EXPECT_EQ(mask("small", "camera_evening_biased-horizon").pixels,
            mask("small", "camera_evening_max-forsyth").pixels);
  // The light's slope is tan 30°, so a horizon raised by 2 hides it everywhere; nor can a horizon
  // lowered by 2 hide it at the foot of a column 4 high, but in the last texel.
  const nlohmann::json dark = resultOf(summary("small"), "dark", "evening", "camera");
  EXPECT_EQ(dark.at("fn"), 0);
  EXPECT_EQ(dark.at("tn"), 0);
  const nlohmann::json light = resultOf(summary("small"), "light", "evening", "camera");
  EXPECT_LT(
      light.at("tp"),
      0.5 * resultOf(summary("small"), "max-forsyth", "evening", "camera").at("tp").get<double>());
}

TEST_F(OwnMethod, IsDescribedByItsOwnDeclaration) {
  runStudy("small", study(method("biased-horizon")));
  const nlohmann::json described = summary("small").at("methods").at(2);
  EXPECT_EQ(described.at("name"), "biased-horizon");
  EXPECT_EQ(described.at("title"), "Flat horizon map with a bias");
  EXPECT_EQ(described.at("citation"), "a user's own file");
}

TEST_F(OwnMethod, ThatAnswersTheOppositeHasTheOppositeError) {
  runStudy("small", study(method("inverted-max-forsyth")));
  EXPECT_DOUBLE_EQ(error("inverted-max-forsyth", "test"), 1 - error("max-forsyth", "test"));
  EXPECT_GT(error("inverted-max-forsyth", "test"), 0.5);
  // On the masks themselves, too.
  const GreyImage plain = mask("small", "test/camera_evening_max-forsyth");
  const GreyImage inverted = mask("small", "test/camera_evening_inverted-max-forsyth");
  for (std::size_t i = 0; i < plain.pixels.size(); ++i) {
    ASSERT_EQ(plain.pixels[i] + inverted.pixels[i], plain.pixels[i] == 128 ? 256 : 255) << i;
  }
}

TEST_F(OwnMethod, IsFoundBesideTheStudy) {
  write("mine.glsl", R"(/* gnomon-method
title = "Always dark"
citation = "a test"
*/
bool isShadowed(Pixel pixel, LocalLight light) { return true; }
)");
  runStudy("small", smallStudy() + "\n[[method]]\nfile = \"mine.glsl\"\n");
  const nlohmann::json result = resultOf(summary("small"), "mine", "evening", "camera");
  EXPECT_EQ(result.at("fnr"), 0);
  EXPECT_EQ(result.at("fpr"), 1);
  // It declares no table, so none is charged to it.
  EXPECT_EQ(summary("small").at("cost").at(2).at("table_bytes"), 0);
}

TEST_F(OwnMethod, HasATexturePassOfItsOwn) {
  runStudy("small", study(method("texture-checks")));
  const GreyImage image = mask("small", "test/camera_evening_texture-checks");
  std::size_t seen = 0;
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      const unsigned char pixel =
          image.pixels[static_cast<std::size_t>(row * image.width + column)];
      if (pixel == 128) continue;
      // The camera stands 80 above a plane of 32 × 32 texels, one world unit each.
      const double reach = 80 * std::tan(15 * 3.14159265358979 / 180);
      const double x = 16 + reach * (2 * (column + 0.5) / image.width - 1);
      const double y = 16 + reach * (1 - 2 * (row + 0.5) / image.height);
      const auto nearEdge = [](double at) { return std::abs(at / 8 - std::round(at / 8)) < 0.07; };
      if (nearEdge(x) || nearEdge(y)) continue;  // between texels the value is bilinear
      ++seen;
      const bool dark = static_cast<int>(std::floor(x / 8) + std::floor(y / 8)) % 2 == 1;
      ASSERT_EQ(pixel, dark ? 0 : 255) << column << " " << row;
    }
  }
  EXPECT_GT(seen, 1000U);
  // 32² texels, each a value and a mark, in floats.
  EXPECT_EQ(summary("small").at("cost").at(2).at("table_bytes"), 32 * 32 * 8);
}

TEST_F(OwnMethod, AllWithAnotherBaseMeshThanTheStudys) {
  runStudy("small", smallStudy(),
           {"--set", "method.0.base.subdivisions=2", "--set", "method.1.base.subdivisions=3"});
  EXPECT_EQ(summary("small").at("cost").at(0).at("polygons"), 4 * 4 * 2 * 4);
  EXPECT_EQ(summary("small").at("cost").at(1).at("polygons"), 4 * 4 * 2 * 9);
}

}  // namespace
}  // namespace gnomon::test
