#include <fmt/core.h>
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "end_to_end/support/program.h"

// Whole runs on a mesh from a file: the same surface in every format, polygons as they are, and a
// face without texture. The same scene in other numbers must have the same shadows. Shadows do not
// depend on the unit of length, on how a periodic map is cut into tiles, or on which way the world
// is turned.
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

using ::testing::HasSubstr;
using ::testing::Not;

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
scheme = "catmull-clark"

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
  runStudy("plates", platesStudy() + "\n[[threshold]]\nregion = \"floor\"\nmax = 0.1\n");
  EXPECT_EQ(summary("plates").at("status"), "fail") << "a part may hold a threshold";
  const nlohmann::json json = summary("plates");
  const nlohmann::json shaded =
      resultOf(json, "unshadowed", "noon", "atlas", "floor shaded by roof");
  EXPECT_NEAR(shaded.at("fn").get<double>(), 1, 0.02);
  EXPECT_EQ(shaded.at("tp"), 0);
  EXPECT_EQ(resultOf(json, "unshadowed", "noon", "atlas", "global").at("fn"), shaded.at("fn"));
}

TEST_F(Parts, HaveNamesOfTheirOwn) {
  write("plates.obj", plate("floor", 2, 0) + plate("seam", 1, 0.3));
  write("plates.toml", platesStudy());
  const Outcome outcome = gnomon({"run", "plates.toml"});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, HasSubstr("surface.mesh"));
  EXPECT_THAT(outcome.err, HasSubstr("seam"));
}

/// The small study on a mesh, in a camera and in an atlas of 7 × 7 samples a face.
std::string studyOf(const std::string& mesh, const std::string& name,
                    const std::string& scheme = "catmull-clark") {
  std::string text = replaced(smallStudy(), "shape = \"plane\"\nquads = [4, 4]\nsize = [32, 32]",
                              "mesh = \"" + mesh + "\"\nscheme = \"" + scheme + "\"");
  text = replaced(text, "name = \"small\"", "name = \"" + name + "\"");
  return replaced(text, "[[light]]", "[[view]]\ntype = \"atlas\"\nsamples = 7\n\n[[light]]");
}

/// Two squares side by side, the second bent upward; its corners as given.
std::string objOf(const std::string& second) {
  return "v -16 -16 0\nv 0 -16 0\nv 16 -16 3\nv -16 16 0\nv 0 16 0\nv 16 16 3\n"
         "vt 0 0\nvt 0.5 0\nvt 0.5 1\nvt 0 1\nvt 1 0\nvt 1 1\n"
         "f 1/1 2/2 5/3 4/4\nf " +
         second + "\n";
}

/// The same, its vertices cut apart where the squares meet.
const std::string cutPly =
    "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\n"
    "property float z\nproperty float s\nproperty float t\nelement face 2\n"
    "property list uchar int vertex_indices\nend_header\n"
    "-16 -16 0 0 0\n0 -16 0 0.5 0\n0 16 0 0.5 1\n-16 16 0 0 1\n"
    "0 -16 0 0.5 0\n16 -16 3 1 0\n16 16 3 1 1\n0 16 0 0.5 1\n4 0 1 2 3\n4 4 5 6 7\n";

class MeshFiles : public EndToEnd {};

TEST_F(MeshFiles, AnObjAndAPlyOfTheSameMeshGiveTheSameFigures) {
  write("mesh.obj", objOf("2/2 3/5 6/6 5/3"));
  write("mesh.ply", cutPly);
  runStudy("from-obj", studyOf("mesh.obj", "from-obj"));
  runStudy("from-ply", studyOf("mesh.ply", "from-ply"));
  const nlohmann::json obj = summary("from-obj");
  const nlohmann::json ply = summary("from-ply");
  EXPECT_EQ(obj.at("results"), ply.at("results"));
  EXPECT_EQ(obj.at("undefined_samples"), 0);
  EXPECT_GT(resultOf(obj, "unshadowed", "evening", "camera").at("prevalence"), 0.02);
}

TEST_F(MeshFiles, AMeshNeedsAScheme) {
  write("mesh.obj", objOf("2/2 3/5 6/6 5/3"));
  write("study.toml", replaced(studyOf("mesh.obj", "study"), "scheme = \"catmull-clark\"\n", ""));
  const Outcome outcome = gnomon({"run", "study.toml"});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, HasSubstr("surface.scheme: missing"));
  EXPECT_THAT(outcome.err, HasSubstr("2 quadrilaterals: catmull-clark would round them"));
}

// ---- polygons as they are

/// The two squares with normals that lean over the common edge, whose own is shared.
std::string leaningObj() {
  return replaced(objOf("2/2/2 3/5/3 6/6/3 5/3/2"), "f 1/1 2/2 5/3 4/4",
                  "vn 0 0 1\nvn -0.2 0 1\nvn 0.1 0.2 1\nf 1/1/1 2/2/2 5/3/2 4/4/1");
}

/// The same with its vertices and their normals apart.
std::string leaningPly() {
  std::string text = replaced(cutPly, "property float s\n",
                              "property double nx\nproperty double ny\nproperty double nz\n"
                              "property float s\n");
  const auto rows = std::array<std::array<const char*, 2>, 8>{{
      {"-16 -16 0 0 0\n", "-16 -16 0 0 0 1 0 0\n"},
      {"0 -16 0 0.5 0\n0 16", "0 -16 0 -0.2 0 1 0.5 0\n0 16"},
      {"0 16 0 0.5 1\n-16", "0 16 0 -0.2 0 1 0.5 1\n-16"},
      {"-16 16 0 0 1\n", "-16 16 0 0 0 1 0 1\n"},
      {"0 -16 0 0.5 0\n16", "0 -16 0 -0.2 0 1 0.5 0\n16"},
      {"16 -16 3 1 0\n", "16 -16 3 0.1 0.2 1 1 0\n"},
      {"16 16 3 1 1\n", "16 16 3 0.1 0.2 1 1 1\n"},
      {"0 16 0 0.5 1\n4", "0 16 0 -0.2 0 1 0.5 1\n4"},
  }};
  for (const auto& [from, to] : rows) text = replaced(text, from, to);
  return text;
}

TEST_F(MeshFiles, PolygonsOfAnObjAndAPlyGiveTheSameFigures) {
  write("mesh.obj", leaningObj());
  write("mesh.ply", leaningPly());
  runStudy("from-obj", studyOf("mesh.obj", "from-obj", "none"));
  runStudy("from-ply", studyOf("mesh.ply", "from-ply", "none"));
  const nlohmann::json obj = summary("from-obj");
  const nlohmann::json ply = summary("from-ply");
  EXPECT_EQ(obj.at("results"), ply.at("results"));
  EXPECT_EQ(obj.at("study").at("settings").at("base").at("curvature"), "vertices");
  EXPECT_GT(resultOf(obj, "unshadowed", "evening", "camera").at("prevalence"), 0.02);
  // A control: without the normals it is another surface.
  write("mesh.obj", objOf("2/2 3/5 6/6 5/3"));
  runStudy("from-obj", studyOf("mesh.obj", "from-obj", "none"));
  EXPECT_NE(obj.at("results"), summary("from-obj").at("results"));
}

/// A plane relief under normals that lean, so that only these decide what is turned away: a light
/// at 30° is behind a normal that leans 70° from it.
TEST_F(MeshFiles, PolygonsAreShadedByTheFilesNormals) {
  const auto darkShare = [this](const std::string& normal) {
    write("mesh.obj", replaced(objOf("2/2/1 3/5/1 6/6/1 5/3/1"), "f 1/1 2/2 5/3 4/4",
                               "vn " + normal + "\nf 1/1/1 2/2/1 5/3/1 4/4/1"));
    runStudy("leaning", studyOf("mesh.obj", "leaning", "none"),
             {"--set", "relief.height=0", "--set", "light.0.azimuth=90"});
    const nlohmann::json result = resultOf(summary("leaning"), "unshadowed", "evening", "atlas");
    return (result.at("tp").get<double>() + result.at("fp").get<double>()) /
           (result.at("tp").get<double>() + result.at("fp").get<double>() +
            result.at("tn").get<double>() + result.at("fn").get<double>());
  };
  EXPECT_EQ(darkShare("0 -1 0.1"), 1);
  EXPECT_EQ(darkShare("0 1 0.1"), 0);
  EXPECT_EQ(darkShare("0 0 1"), 0);
}

TEST_F(MeshFiles, PolygonsAreMeasuredByEveryMethodAndTheBestAreNearTheTruth) {
  write("mesh.obj", leaningObj());
  std::string text = studyOf("mesh.obj", "all", "none");
  for (const char* method : {"surface-march", "two-scales", "two-scales-surface", "shadow-map",
                             "shadow-volume", "sloan-cohen-surface", "geodesic-march"}) {
    text += std::string("\n[[method]]\nname = \"") + method + "\"\n";
  }
  runStudy("all", text);
  const nlohmann::json all = summary("all");
  const auto error = [&](const char* method) {
    return resultOf(all, method, "evening", "atlas").at("error_rate").get<double>();
  };
  EXPECT_EQ(all.at("undefined_samples"), 0);
  EXPECT_LT(error("surface-march"), 0.02);
  EXPECT_LT(error("two-scales-surface"), 0.02);
  // Its depth map's pieces are coarse: 9 on a side of 16 texels.
  EXPECT_LT(error("two-scales"), 0.5 * error("unshadowed"));
}

// A clamped map goes on beyond its sides as they are: a face there is flat, and was 0.00 % wrong.
TEST_F(MeshFiles, FacesOutsideAClampedMapAreTold) {
  const std::string inside = "f 1/1 2/2 5/3 4/4\nf 2/2 3/5 6/6 5/3\n";
  const auto meshWith = [&](const std::string& faces) {
    return replaced(objOf("2/2 3/5 6/6 5/3"), inside, "vt 2 0\nvt 3 0\nvt 3 1\nvt 2 1\n" + faces);
  };
  write("half.obj", meshWith("f 1/1 2/2 5/3 4/4\nf 2/7 3/8 6/9 5/10\n"));
  write("none.obj", meshWith("f 1/7 2/8 5/9 4/10\nf 2/7 3/8 6/9 5/10\n"));
  runStudy("half", studyOf("half.obj", "half"), {"--set", "relief.wrap=clamp"});
  EXPECT_THAT(summary("half").at("notices").dump(),
              HasSubstr("1 of 2 faces have texture coordinates outside the map"));
  runStudy("half", studyOf("half.obj", "half"), {"--set", "relief.wrap=repeat"});
  EXPECT_THAT(summary("half").at("notices").dump(), Not(HasSubstr("outside the map")));
  write("none.toml", studyOf("none.obj", "none"));
  const Outcome refused = gnomon({"run", "none.toml", "--set", "relief.wrap=clamp"});
  EXPECT_EQ(refused.status, 3);
  EXPECT_THAT(refused.err, HasSubstr("relief.wrap: clamp found"));
}

TEST_F(MeshFiles, SamplesOfAFaceWithoutTextureAreCountedAndLeftOut) {
  write("whole.obj", objOf("2/2 3/5 6/6 5/3"));
  write("half.obj", objOf("2 3 6 5"));
  runStudy("whole", studyOf("whole.obj", "whole"));
  runStudy("half", studyOf("half.obj", "half"));
  const auto samples = [](const nlohmann::json& summary, const std::string& view) {
    return resultOf(summary, "max-forsyth", "evening", view).at("samples").get<int>();
  };
  EXPECT_EQ(samples(summary("whole"), "atlas"), 2 * 7 * 7);
  EXPECT_EQ(samples(summary("half"), "atlas"), 7 * 7);
  const int missing = samples(summary("whole"), "camera") - samples(summary("half"), "camera");
  EXPECT_GT(missing, samples(summary("half"), "camera") / 2);
  EXPECT_EQ(summary("half").at("undefined_samples"), 7 * 7 + missing);
  // What is left has its shadows still: those of the same relief.
  EXPECT_GT(resultOf(summary("half"), "unshadowed", "evening", "atlas").at("prevalence"), 0.02);
  EXPECT_LT(resultOf(summary("half"), "max-forsyth", "evening", "atlas").at("error_rate"), 0.2);
}

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
