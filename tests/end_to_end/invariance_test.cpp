#include <fmt/core.h>
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "end_to_end/support/program.h"

// The same scene in other numbers must have the same shadows. Shadows do not depend on the unit of
// length, on how a periodic map is cut into tiles, or on which way the world is turned.
//
// Where the numbers change only in ways that floats carry exactly (a scale of 2^k, a longer map of
// the same period), every mask must be the same. Elsewhere a sample may flip whose shadow's edge
// rounding moves across it: coordinates round at 2^-24 of the scene's extent, that is by 6e-6
// texels of the hundred here, and a few operations on them by some 1e-4; with less than one texel
// of shadow edge for every four texels of surface that is 3e-5 of all samples. So of the 8,000 and
// more of each view here at most one is expected, and 2 are allowed. More are where a method has
// more edges: see flipsOfRounding.

namespace gnomon::test {
namespace {

constexpr std::array allMethods = {
    "ellipse",       "geodesic-march",   "max-forsyth",         "onoue-2003",        "onoue-2004",
    "onoue-exact",   "osculating-march", "relief-march",        "resampled-horizon", "shadow-map",
    "shadow-volume", "sloan-cohen",      "sloan-cohen-surface", "surface-march",     "unshadowed"};

/// How many samples of a view rounding may flip.
int flipsOfRounding(const std::string& method) {
  // 64 heights on the way are held against the light, each with an edge of its own.
  if (method == "relief-march") return 8;
  // Angles are in steps of 8 bits, whose borders are edges too.
  if (method == "sloan-cohen-surface") return 8;
  // 16 depths a sample; and a rasteriser snaps the depth map's triangles to parts of its texels, so
  // that a turn draws other texels along their sides.
  if (method == "shadow-map") return 32;
  // Volumes are clipped: their sides go to infinity, which has no unit of length.
  return method == "shadow-volume" ? 4 : 2;
}

struct Scene {
  std::string name;
  bool bezier = false;
  double scale = 1;
  double turn = 0;       ///< degrees about z
  double lightTurn = 0;  ///< degrees about z
  std::string heightSpace = "world";
  int texels = 64;
  int repeats = 1;
};

constexpr std::array<std::array<double, 3>, 16> bezierPoints = {{
    {-33, -40, -24},
    {-25, -40, 17},
    {25, -40, 17},
    {33, -40, -24},
    {-33, -14, -12},
    {-25, -14, 29},
    {25, -14, 29},
    {33, -14, -12},
    {-33, 14, -12},
    {-25, 14, 29},
    {25, 14, 29},
    {33, 14, -12},
    {-33, 40, -24},
    {-25, 40, 17},
    {25, 40, 17},
    {33, 40, -24},
}};

/// A point or direction of the scene, turned about z and scaled.
std::string placed(const std::array<double, 3>& p, double turn, double scale) {
  const double angle = turn * 3.14159265358979323846 / 180;
  // A quarter turn is exact, and so shows that nothing but rounding is at work in others.
  const double c = turn == 90 ? 0 : std::cos(angle);
  const double s = turn == 90 ? 1 : std::sin(angle);
  return fmt::format("[{:.17e}, {:.17e}, {:.17e}]", scale * (c * p[0] - s * p[1]),
                     scale * (s * p[0] + c * p[1]), scale * p[2]);
}

std::string surface(const Scene& scene) {
  if (!scene.bezier) {
    return fmt::format("shape = \"sphere\"\ncurvature = {}\nsize = [{}, {}]\nquads = [24, 24]\n",
                       0.02 / scene.scale, 64 * scene.scale, 64 * scene.scale);
  }
  std::string text = "shape = \"bezier\"\nquads = [16, 16]\npoints = [\n";
  for (const auto& point : bezierPoints) text += placed(point, scene.turn, scene.scale) + ",\n";
  return text + "]\n";
}

std::string methodTables() {
  std::string text;
  for (const char* method : allMethods) text += fmt::format("[[method]]\nname = \"{}\"\n", method);
  return text;
}

std::string studyOf(const Scene& scene) {
  const double height = scene.heightSpace == "world" ? 6 * scene.scale : 6;
  return fmt::format(R"([study]
name = "{}"
title = "Columns, told in other numbers"
source = "a test"
frames = 0
[surface]
{}
[relief]
pattern = "columns"
texels = [{}, {}]
repeats = [{}, {}]
period = 16
radius = 4
wall = 1
height = {}
height_space = "{}"
[bake]
azimuths = 16
radius = 32
[truth]
step = 0.25
[[view]]
type = "camera"
width = 160
height = 160
eye = {}
target = {}
up = {}
fov = 32
[[view]]
type = "atlas"
samples = 7
[[light]]
name = "noon"
azimuth = {}
elevation = 45
[[light]]
name = "dusk"
azimuth = {}
elevation = 25
{})",
                     scene.name, surface(scene), scene.texels, scene.texels, scene.repeats,
                     scene.repeats, height, scene.heightSpace,
                     placed({0, -60, 150}, scene.turn, scene.scale),
                     placed({0, 0, 20}, scene.turn, scene.scale), placed({0, 1, 0}, scene.turn, 1),
                     20 + scene.lightTurn, 20 + scene.lightTurn, methodTables());
}

class Invariance : public EndToEnd {
 protected:
  void run(const Scene& scene) const { runStudy(scene.name, studyOf(scene)); }

  /// How many samples of the masks of two scenes differ at most, by method; "truth" is one.
  [[nodiscard]] std::map<std::string, int> differences(const std::string& a,
                                                       const std::string& b) const {
    std::map<std::string, int> most;
    for (const char* view : {"camera", "atlas"}) {
      for (const char* light : {"noon", "dusk"}) {
        std::vector<std::string> shown(allMethods.begin(), allMethods.end());
        shown.push_back("truth");
        for (const std::string& method : shown) {
          if (method == "shadow-volume" && view == std::string("atlas")) continue;  // shows none
          const std::string name = fmt::format("{}_{}_{}", view, light, method);
          const int count = countDifferences(mask(a, name), mask(b, name));
          EXPECT_LT(count, 1'000'000) << name << ": other samples";
          most[method] = std::max(most[method], count);
        }
      }
    }
    return most;
  }
  void expectTheSame(const std::string& a, const std::string& b) const {
    for (const auto& [method, count] : differences(a, b)) {
      const bool isExact = method != "shadow-volume";  // see flipsOfRounding
      EXPECT_LE(count, isExact ? 0 : flipsOfRounding(method)) << method << ", " << b;
    }
  }
  void expectTheSameButForRounding(const std::string& a, const std::string& b) const {
    for (const auto& [method, count] : differences(a, b)) {
      EXPECT_LE(count, flipsOfRounding(method)) << method << ", " << b;
    }
  }
  /// What a control must show of every method.
  void expectOthers(const std::string& a, const std::string& b) const {
    for (const auto& [method, count] : differences(a, b)) EXPECT_GT(count, 300) << method;
  }
  [[nodiscard]] int tableBytes(const std::string& scene, const std::string& method) const {
    const nlohmann::json costs = summary(scene).at("cost");
    for (const nlohmann::json& cost : costs) {
      if (cost.at("method") == method) return cost.at("table_bytes");
    }
    return 0;
  }
  /// A scene that is dark or lit all over would show nothing.
  void expectSomethingToSee(const std::string& name) const {
    for (const char* view : {"camera", "atlas"}) {
      for (const char* light : {"noon", "dusk"}) {
        const nlohmann::json result = resultOf(summary(name), "max-forsyth", light, view);
        EXPECT_GT(result.at("samples"), 8000);
        EXPECT_GT(result.at("prevalence"), 0.1);
        EXPECT_LT(result.at("prevalence"), 0.9);
        EXPECT_GT(result.at("error_rate"), 0.02);
      }
    }
  }

 private:
  static int countDifferences(const GreyImage& a, const GreyImage& b) {
    if (a.width != b.width || a.height != b.height) return 1'000'000;
    int differences = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) differences += a.pixels[i] != b.pixels[i];
    return differences;
  }
};

TEST_F(Invariance, UnitOfLength) {
  run({.name = "one"});
  expectSomethingToSee("one");
  run({.name = "sixteen", .scale = 16});
  run({.name = "ten", .scale = 10});
  expectTheSame("one", "sixteen");
  expectTheSameButForRounding("one", "ten");
  // The control: heights that do not scale with the world are another scene.
  runStudy("low", replaced(studyOf({.name = "low", .scale = 10}), "height = 60", "height = 6"));
  expectOthers("one", "low");
}

TEST_F(Invariance, UnitOfLengthWithHeightsInTexels) {
  run({.name = "one", .heightSpace = "texture"});
  expectSomethingToSee("one");
  run({.name = "ten", .scale = 10, .heightSpace = "texture"});
  expectTheSameButForRounding("one", "ten");
}

/// Both are laid more than once over the open patch, so that neither knows where it ends.
TEST_F(Invariance, TilesOfAMap) {
  run({.name = "whole", .texels = 64, .repeats = 2});
  expectSomethingToSee("whole");
  run({.name = "tiles", .texels = 32, .repeats = 4});
  expectTheSame("whole", "tiles");
  for (const char* method : {"max-forsyth", "ellipse"}) {
    EXPECT_GT(tableBytes("tiles", method), 0) << method;
    EXPECT_EQ(tableBytes("whole", method), 4 * tableBytes("tiles", method)) << method;
  }
}

TEST_F(Invariance, DirectionOfTheWorld) {
  run({.name = "ahead", .bezier = true});
  expectSomethingToSee("ahead");
  run({.name = "quarter", .bezier = true, .turn = 90, .lightTurn = 90});
  run({.name = "turned", .bezier = true, .turn = 30, .lightTurn = 30});
  expectTheSameButForRounding("ahead", "quarter");
  expectTheSameButForRounding("ahead", "turned");
  // The control: a light that does not turn along is another one.
  run({.name = "left-behind", .bezier = true, .turn = 30});
  expectOthers("ahead", "left-behind");
}

}  // namespace
}  // namespace gnomon::test
