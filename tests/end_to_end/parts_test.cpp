#include <gmock/gmock.h>

#include <set>

#include "end_to_end/support/program.h"

namespace gnomon::test {
namespace {

using ::testing::HasSubstr;

/// A plate of side 2 at z = `height`, in 4 × 4 faces, with the whole texture.
std::string plate(const std::string& name, double side, double height) {
  std::string text = "o " + name + "\n";
  for (int j = 0; j <= 4; ++j) {
    for (int i = 0; i <= 4; ++i) {
      text += "v " + std::to_string(side * (i / 4.0 - 0.5)) + " " +
              std::to_string(side * (j / 4.0 - 0.5)) + " " + std::to_string(height) + "\nvt " +
              std::to_string(i / 4.0) + " " + std::to_string(j / 4.0) + "\n";
    }
  }
  const auto corner = [](int i, int j) {
    const std::string index = std::to_string(5 * (j - 5) + (i - 5) + 5);
    return " " + index + "/" + index;
  };
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      text +=
          "f" + corner(i, j) + corner(i + 1, j) + corner(i + 1, j + 1) + corner(i, j + 1) + "\n";
    }
  }
  return text;
}

std::string platesStudy(const std::string& height = "0.05") {
  return R"([study]
name = "plates"
title = "A plate above another"
source = "a test"
frames = 0
[surface]
mesh = "plates.obj"

[relief]
pattern = "columns"
texels = [32, 32]
period = 16
radius = 4
height = )" +
         height + R"(
height_space = "world"
wrap = "clamp"

[[view]]
type = "atlas"
samples = 9

[[light]]
name = "noon"
azimuth = 20
elevation = 50

[[method]]
name = "unshadowed"
)";
}

class Parts : public EndToEnd {};

/// Both plates carry columns that shade their own plate; the roof shades the floor.
TEST_F(Parts, AreToldApartByReceiverAndCaster) {
  write("plates.obj", plate("floor", 2, 0) + plate("roof", 1, 0.3));
  runStudy("plates", platesStudy("0.2"));
  const nlohmann::json json = summary("plates");
  const auto count = [&](const std::string& region, const char* key) {
    return resultOf(json, "unshadowed", "noon", "atlas", region).at(key).get<double>();
  };
  for (const char* key : {"samples", "tp", "fp", "fn", "tn"}) {
    EXPECT_NEAR(count("floor", key) + count("roof", key), count("all", key), 1e-9) << key;
    EXPECT_NEAR(count("floor shaded by floor", key) + count("floor shaded by roof", key) +
                    count("roof shaded by roof", key) + count("roof shaded by floor", key),
                count("cast", key) + count("distant", key) + count("global", key), 1e-9)
        << key;
  }
  EXPECT_EQ(count("floor", "samples"), 16 * 81);
  for (const char* region :
       {"floor shaded by floor", "floor shaded by roof", "roof shaded by roof"}) {
    EXPECT_GT(count(region, "fn"), 0) << region;
  }
  EXPECT_EQ(count("roof shaded by floor", "samples"), 0);
  // Another plate is not where the path leads.
  EXPECT_GE(count("global", "samples"), count("floor shaded by roof", "samples"));
  EXPECT_THAT(read("out/plates/metrics.csv"), HasSubstr(",floor shaded by roof,"));
}

/// The roof's shadow is its own size, of the area 1, all of which is wrong without shadows.
TEST_F(Parts, ARoofShadesAsMuchAsItCovers) {
  write("plates.obj", plate("floor", 2, 0) + plate("roof", 1, 0.3));
  runStudy("plates", platesStudy());
  const nlohmann::json json = summary("plates");
  const nlohmann::json shaded =
      resultOf(json, "unshadowed", "noon", "atlas", "floor shaded by roof");
  EXPECT_NEAR(shaded.at("fn").get<double>(), 1, 0.02);
  EXPECT_EQ(shaded.at("tp"), 0);
  EXPECT_EQ(resultOf(json, "unshadowed", "noon", "atlas", "global").at("fn"), shaded.at("fn"));
}

TEST_F(Parts, MayHoldThresholds) {
  write("plates.obj", plate("floor", 2, 0) + plate("roof", 1, 0.3));
  const std::string threshold = "\n[[threshold]]\nregion = \"floor\"\nmax = ";
  write("plates.toml", platesStudy() + threshold + "0.5\n");
  EXPECT_EQ(gnomon({"check", "plates.toml"}).status, 0);
  write("plates.toml", platesStudy() + threshold + "0.1\n");
  EXPECT_EQ(gnomon({"check", "plates.toml"}).status, 1);
  write("plates.toml", platesStudy() + "\n[[threshold]]\nregion = \"ceiling\"\nmax = 0.5\n");
  const Outcome outcome = gnomon({"check", "plates.toml"});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, HasSubstr("roof shaded by roof expected"));
}

TEST_F(Parts, HaveNamesOfTheirOwn) {
  write("plates.obj", plate("floor", 2, 0) + plate("seam", 1, 0.3));
  write("plates.toml", platesStudy());
  const Outcome outcome = gnomon({"run", "plates.toml"});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, HasSubstr("surface.mesh"));
  EXPECT_THAT(outcome.err, HasSubstr("seam"));
}

/// One part has no rows of its own: every byte is that of a file without names.
TEST_F(Parts, OneIsNoPart) {
  write("plates.obj", plate("floor", 2, 0));
  runStudy("plates", platesStudy());
  const std::string named = read("out/plates/metrics.csv");
  std::string text = plate("floor", 2, 0);
  write("plates.obj", text.substr(text.find('\n') + 1));
  runStudy("plates", platesStudy());
  EXPECT_EQ(read("out/plates/metrics.csv"), named);
  EXPECT_THAT(named, ::testing::Not(HasSubstr("shaded by")));
}

}  // namespace
}  // namespace gnomon::test
