#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>

#include "end_to_end/support/exported.h"
#include "end_to_end/support/program.h"
#include "support/image_files.h"

// What a camera's own rays meet of the displaced mesh, as `gnomon export` writes it.
// docs/blender.py, where Blender is installed: another renderer's masks come back within what the
// truth is uncertain by.

namespace gnomon::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// What another renderer finds: 1 lit, 0 shadowed, alpha 0 where there is nothing.
TestPicture rendered(const Channels& samples, const Triangles& mesh, const Point& light,
                     double lift) {
  const SunRays rays(mesh, light);
  TestPicture picture{samples.width, samples.height, {"Y", "A"}, {}};
  for (std::size_t i = 0; i < samples.of.at("face").size(); ++i) {
    const bool sample = samples.of.at("face")[i] >= 0;
    const Point facet = samples.point("facet", i);
    Point origin = samples.point("point", i);
    for (std::size_t k = 0; k < 3; ++k) origin.at(k) += lift * facet.at(k);
    const bool lit = sample && dot(facet, light) > 0 && !rays.blocked(origin);
    picture.values.insert(picture.values.end(), {lit ? 1.0F : 0.0F, sample ? 1.0F : 0.0F});
  }
  return picture;
}

class Export : public ExportEndToEnd {
 protected:
  void prepare() override {
    exported("small", smallStudy());
    exported("ring", torusStudy(), {"--subdivisions", "8"});
  }
  /// Renders every view under every light from the export alone and has the masks compared.
  void expectReproduced(const std::string& name, const nlohmann::json& about, double lift) const {
    const auto part = [&](const std::string& path) { return "out/" + name + "/export/" + path; };
    const Triangles mesh = readPly(file(part(about.at("displaced_mesh").at("file"))));
    for (const nlohmann::json& view : about.at("views")) {
      const Channels samples = readChannels(file(part(view.at("samples"))));
      for (std::size_t l = 0; l < about.at("lights").size(); ++l) {
        const Point light = pointOf(about.at("lights").at(l).at("direction"));
        writePicture(file("mine.exr"), rendered(samples, mesh, light, lift));
        const nlohmann::json& mask = view.at("masks").at(l);
        EXPECT_EQ(mask.at("light"), about.at("lights").at(l).at("name"));
        const Outcome outcome =
            gnomon({"compare", "mine.exr", part(mask.at("truth")), "--roi", part(view.at("roi")),
                    "--max", "error_rate=0.01", "--json", "-"});
        EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
        const nlohmann::json found = nlohmann::json::parse(outcome.out);
        EXPECT_GT(found.at("samples"), 1000) << view.at("name");
        // There is light and shadow to agree on.
        EXPECT_GT(found.at("prevalence"), 0.05);
        EXPECT_LT(found.at("prevalence"), 0.8);
        RecordProperty(view.at("name").get<std::string>() + mask.at("light").get<std::string>(),
                       found.at("error_rate").dump());
      }
    }
  }
};

TEST_F(Export, AnotherRendererReproducesTheTruthOnAPlane) {
  // Cut as the truth's own mesh, so that rays need no more lift than the truth's.
  const nlohmann::json about =
      exported("fine", replaced(smallStudy(), "\"small\"", "\"fine\""), {"--subdivisions", "32"});
  EXPECT_EQ(about.at("displaced_mesh").at("closed"), false);
  expectReproduced("fine", about, about.at("ray_lift"));
}

TEST_F(Export, AnotherRendererReproducesTheTruthOnAClosedSurface) {
  const nlohmann::json about = aboutOf("ring");
  EXPECT_EQ(about.at("displaced_mesh").at("triangles"), 64 * 60 * 8 * 8 * 2);
  const Triangles mesh = readPly(file("out/ring/export/displaced.ply"));
  EXPECT_EQ(mesh.faces.size(), 64U * 60U * 8U * 8U * 2U);
  EXPECT_EQ(mesh.vertices.size(), 64U * 60U * 8U * 8U) << "each vertex once: Euler's 0 of a torus";
  EXPECT_EQ(openSides(mesh), 0U);
  EXPECT_EQ(about.at("displaced_mesh").at("closed"), true);
  // Its mesh is finer than the truth's, whose points lie this near to it.
  expectReproduced("ring", about, 0.02);
}

TEST_F(Export, SampleMapsAreTheSameInAllForms) {
  const nlohmann::json about = aboutOf("small");
  const nlohmann::json& view = about.at("views").at(0);
  const auto path = [&](const char* form) {
    return "out/small/export/" + view.at(form).get<std::string>();
  };
  const Channels plain = readChannels(file(path("samples")));
  const Channels layers = readChannels(file(path("samples_layers")));
  ASSERT_EQ(layers.of.size(), plain.of.size());
  for (const auto& [name, values] : layers.of) {
    ASSERT_EQ(name[name.size() - 2], '.') << name;
    EXPECT_THAT("XYZ", HasSubstr(name.substr(name.size() - 1))) << name;
  }
  for (const auto& [name, layer] : std::map<std::string, std::string>{
           {"face", "place.X"}, {"s", "place.Y"}, {"t", "place.Z"}, {"weight", "texel.Z"}}) {
    EXPECT_EQ(layers.of.at(layer), plain.of.at(name)) << name;
  }
  EXPECT_EQ(layers.of.at("point.Y"), plain.of.at("point.Y"));
  // NumPy's: a header in whole lines of 64 bytes, then the floats.
  const std::string bytes = read(path("samples_npy"));
  const std::size_t begin = bytes.find('\n') + 1;
  EXPECT_EQ(begin % 64, 0U);
  EXPECT_EQ(bytes.substr(1, 5), "NUMPY");
  EXPECT_THAT(bytes.substr(0, begin), HasSubstr("'shape': (64, 64, 18)"));
  std::vector<float> values((bytes.size() - begin) / sizeof(float));
  std::memcpy(values.data(), bytes.data() + begin, bytes.size() - begin);
  const nlohmann::json& order = about.at("channel_order");
  ASSERT_EQ(values.size(), 64U * 64U * order.size());
  for (std::size_t c = 0; c < order.size(); ++c) {
    const std::vector<float>& channel = plain.of.at(order.at(c));
    for (std::size_t i = 0; i < channel.size(); ++i) {
      ASSERT_EQ(values[i * order.size() + c], channel[i]) << order.at(c) << " of " << i;
    }
  }
}

TEST_F(Export, TheMeshsDistanceToTheTruthIsMeasured) {
  const nlohmann::json own = aboutOf("small").at("displaced_mesh");
  EXPECT_EQ(own.at("subdivisions"), 64) << "8 a texel";
  EXPECT_LT(own.at("distance").at("largest_texels"), 0.05);
  EXPECT_LT(own.at("distance").at("mean_texels"), 0.001);
  // One piece a face: two triangles, which on a plane lie right below or above every sample.
  const nlohmann::json about = exported("coarse", replaced(smallStudy(), "\"small\"", "\"coarse\""),
                                        {"--subdivisions", "1"});
  const Triangles mesh = readPly(file("out/coarse/export/displaced.ply"));
  const Channels samples = readChannels(file("out/coarse/export/samples/camera.exr"));
  double largest = 0, sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < samples.of.at("face").size(); ++i) {
    if (samples.of.at("face")[i] < 0) continue;
    const double s = samples.of.at("s")[i];
    const double t = samples.of.at("t")[i];
    const bool lower = s + t <= 1;
    const auto& corners =
        mesh.faces.at(2 * std::size_t(samples.of.at("face")[i]) + (lower ? 0 : 1));
    const auto height = [&](std::size_t k) { return mesh.vertices.at(corners.at(k))[2]; };
    const double flat = height(0) + (lower ? s : 1 - s) * (height(1) - height(0)) +
                        (lower ? t : 1 - t) * (height(2) - height(0));
    const double apart = std::abs(samples.of.at("point.Z")[i] - flat);
    largest = std::max(largest, apart);
    sum += apart;
    ++count;
  }
  const nlohmann::json& distance = about.at("displaced_mesh").at("distance");
  EXPECT_EQ(distance.at("samples"), count);
  EXPECT_NEAR(distance.at("largest"), largest, 1e-5);
  EXPECT_NEAR(distance.at("mean"), sum / double(count), 1e-5);
  EXPECT_NEAR(distance.at("largest_texels"), largest, 1e-5) << "a texel is one world unit";
  EXPECT_GT(largest, 1);
}

TEST_F(Export, TheHeightMapIsTheStudysOwn) {
  runStudy("small", smallStudy());
  const nlohmann::json about = aboutOf("small");
  EXPECT_EQ(about.at("height_map").at("maximum"), 4);
  const std::string own = smallStudy();
  const std::size_t begin = own.find("pattern");
  const std::size_t end = own.find("height_space");
  const std::string taken = own.substr(0, begin) +
                            "image = \"out/small/export/heights.exr\"\nheight = 1\n" +
                            own.substr(end);
  runStudy("taken", replaced(taken, "\"small\"", "\"taken\""));
  EXPECT_EQ(mask("taken", "camera_evening_truth").pixels,
            mask("small", "camera_evening_truth").pixels);
}

TEST_F(Export, TruthsAndTablesAreThoseOfTheOtherCommands) {
  runStudy("small", smallStudy());
  EXPECT_EQ(gnomon({"bake", "small.toml"}).status, 0);
  EXPECT_EQ(gnomon({"truth", "small.toml"}).status, 0);
  const std::string mask = "masks/camera_evening_truth.png";
  EXPECT_EQ(read("out/small/export/" + mask), read("out/small/" + mask));
  EXPECT_EQ(read("out/small/truth/" + mask), read("out/small/" + mask));
  EXPECT_EQ(read("out/small/export/tables.exr"), read("out/small/tables.exr"));
  const nlohmann::json run = summary("small");
  const nlohmann::json truth = nlohmann::json::parse(read("out/small/truth/truth.json"));
  EXPECT_EQ(truth.at("truth").at("uncertainty"), run.at("truth").at("uncertainty"));
  const nlohmann::json& found = truth.at("cases").at(0);
  for (const char* region : {"lit", "attached", "cast", "distant", "global", "beyond-terminator"}) {
    EXPECT_EQ(found.at("region_samples").at(region),
              resultOf(run, "unshadowed", "evening", "camera", region).at("samples"))
        << region;
  }
  // The picture of the regions holds as many pixels of each colour.
  const GreyImage red = readGrey(file("out/small/truth/regions/camera_evening.png"));
  for (const char* region : {"lit", "attached", "cast"}) {
    const int colour = truth.at("region_colours").at(region).at(0);
    EXPECT_EQ(std::count(red.pixels.begin(), red.pixels.end(), colour),
              found.at("region_samples").at(region))
        << region;
  }
}

TEST_F(Export, TheSameStudyGivesTheSameBytes) {
  const std::vector<std::string> files = filesBelow("out/small/export");
  EXPECT_EQ(files, (std::vector<std::string>{
                       "base.obj", "displaced.ply", "drawn/masks/camera_evening_truth.png",
                       "drawn/samples/camera.exr", "drawn/samples/camera.npy",
                       "drawn/samples/camera_layers.exr", "export.json", "files.txt", "heights.exr",
                       "masks/camera_evening_truth.png", "roi/camera.png", "samples/camera.exr",
                       "samples/camera.npy", "samples/camera_layers.exr", "tables.exr"}));
  ASSERT_EQ(gnomon({"export", "small.toml", "--out", "again", "--threads", "1"}).status, 0);
  for (const std::string& name : files) {
    if (name == "export.json") continue;  // it names the command and the threads
    EXPECT_EQ(read("out/small/export/" + name), read("again/small/export/" + name)) << name;
  }
}

TEST_F(Export, AnAtlasWeighsItsSamplesByArea) {
  const nlohmann::json about = aboutOf("ring");
  const nlohmann::json& atlas = about.at("views").at(1);
  EXPECT_EQ(atlas.at("type"), "atlas");
  EXPECT_EQ(atlas.at("atlas").at("columns"), 64);
  EXPECT_EQ(atlas.at("width"), 64 * 3);
  const Channels samples = readChannels(file("out/ring/export/samples/atlas.exr"));
  double area = 0;
  for (const float weight : samples.of.at("weight")) area += weight;
  const double exact = 4 * M_PI * M_PI * 40 * 15;
  EXPECT_NEAR(area, exact, 1e-3 * exact);
  // The bottom left tile is face 0, its first sample at (1, 1) / 6.
  const std::size_t corner = std::size_t(60 * 3 - 1) * 64 * 3;
  EXPECT_EQ(samples.of.at("face")[corner], 0);
  EXPECT_NEAR(samples.of.at("s")[corner], 1.0 / 6, 1e-6);
  EXPECT_NEAR(samples.of.at("t")[corner], 1.0 / 6, 1e-6);
}

TEST_F(Export, WhatCannotBeExportedIsRefusedBeforeItIsMade) {
  write("odd.toml", replaced(smallStudy(), "\"small\"", "\"odd\""));
  for (const char* pieces : {"0", "8193"}) {
    const Outcome outcome = gnomon({"export", "odd.toml", std::string("--subdivisions=") + pieces});
    EXPECT_EQ(outcome.status, 3);
    EXPECT_THAT(outcome.err,
                AllOf(HasSubstr("odd.toml: subdivisions: "), HasSubstr("1 to 8192 expected")));
  }
  const Outcome many =
      gnomon({"export", "odd.toml", "--subdivisions", "8000", "--set", "surface.quads=[64, 64]"});
  EXPECT_NE(many.status, 0);
  EXPECT_THAT(many.err, HasSubstr("subdivisions: 8000"));
  EXPECT_TRUE(filesBelow("out/odd").empty());
  // What an earlier export left does not pass for a whole one.
  exported("odd", read("odd.toml"));
  EXPECT_NE(gnomon({"export", "odd.toml", "--set", "view.0.eye=[0,0,-80]"}).status, 0);
  EXPECT_FALSE(std::filesystem::exists(file("out/odd/export/export.json")));
}

TEST_F(Export, ASweepHasAnExportForEveryValue) {
  write("swept.toml",
        replaced(smallStudy(), "\"small\"", "\"swept\"") +
            "\n[sweep]\nkey = \"relief.height\"\nvalues = [2, 4]\naxis = \"height\"\n");
  EXPECT_EQ(gnomon({"export", "swept.toml"}).status, 0);
  EXPECT_TRUE(std::filesystem::exists(file("out/swept/2/export/export.json")));
  EXPECT_TRUE(std::filesystem::exists(file("out/swept/4/export/export.json")));
}

class ExportDrawn : public ExportEndToEnd {
 protected:
  void prepare() override {
    exported("ring", torusStudy(), {"--subdivisions", "8"});
    // The first light as a disc.
    exported("soft",
             replaced(replaced(torusStudy(), "\"ring\"", "\"soft\""), "elevation = 60\n",
                      "elevation = 60\nradius = 8\n"),
             {"--subdivisions", "4"});
  }
};

TEST_F(ExportDrawn, WhatACameraDrawsOfTheDisplacedMeshIsThere) {
  const nlohmann::json about = aboutOf("ring");
  const nlohmann::json& view = about.at("views").at(0);
  EXPECT_TRUE(about.at("views").at(1).at("drawn").is_null()) << "an atlas has no rays";
  const auto part = [&](const nlohmann::json& name) {
    return file("out/ring/export/" + name.get<std::string>());
  };
  const Channels drawn = readChannels(part(view.at("drawn").at("samples")));
  const Triangles mesh = readPly(file("out/ring/export/displaced.ply"));
  const Point eye = pointOf(view.at("camera").at("eye"));
  const auto pixels = static_cast<std::size_t>(drawn.width) * std::size_t(drawn.height);
  for (std::size_t l = 0; l < 2; ++l) {
    const Point light = pointOf(about.at("lights").at(l).at("direction"));
    const SunRays rays(mesh, light);
    const GreyImage mask = readGrey(part(view.at("drawn").at("masks").at(l).at("truth")));
    std::size_t seen = 0, shadowed = 0, differ = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
      const Point facet = drawn.point("facet", i);
      ASSERT_EQ(mask.pixels[i] == 128, dot(facet, facet) == 0) << i;
      if (mask.pixels[i] == 128) continue;
      const Point point = drawn.point("point", i);
      EXPECT_GT(dot(facet, minus(eye, point)), 0) << "it faces the eye";
      ++seen;
      // Its mesh is finer than the truth's, whose points lie this near to it.
      Point origin = point;
      for (std::size_t k = 0; k < 3; ++k) origin.at(k) += 0.02 * facet.at(k);
      const bool lit = dot(facet, light) > 0 && !rays.blocked(origin);
      shadowed += lit ? 0 : 1;
      differ += lit != (mask.pixels[i] == 255) ? 1 : 0;
    }
    EXPECT_GT(seen, 2000U);
    EXPECT_GT(shadowed, seen / 20);
    EXPECT_LT(double(differ), 0.01 * double(seen));
  }
}

/// Directions of about equal solid angle toward a disc, in rings.
std::vector<Point> towardDisc(const Point& centre, double radius, int rings) {
  Point level = cross({0, 0, 1}, centre);
  const double length = std::sqrt(dot(level, level));
  for (double& x : level) x /= length;
  const Point upward = cross(centre, level);
  std::vector<Point> directions;
  for (int ring = 0; ring < rings; ++ring) {
    const int count = 2 * ring + 1;  // the ring from r = ring / rings to the next has that area
    const double aside = std::sin(radius) * (ring + 0.5) / rings;
    for (int k = 0; k < count; ++k) {
      const double angle = 2 * 3.14159265358979 * (k + 0.3) / count;
      Point direction{};
      for (std::size_t j = 0; j < 3; ++j) {
        direction.at(j) = std::sqrt(1 - aside * aside) * centre.at(j) +
                          aside * (std::cos(angle) * level.at(j) + std::sin(angle) * upward.at(j));
      }
      directions.push_back(direction);
    }
  }
  return directions;
}

TEST_F(ExportDrawn, WhatACameraDrawsUnderADiscAreShares) {
  const nlohmann::json about = aboutOf("soft");
  const nlohmann::json& view = about.at("views").at(0);
  const nlohmann::json& mask = view.at("drawn").at("masks").at(0);
  const auto part = [](const nlohmann::json& name) {
    return "out/soft/export/" + name.get<std::string>();
  };
  const Channels drawn = readChannels(file(part(view.at("drawn").at("samples"))));
  const Channels shares = readChannels(file(part(mask.at("shares"))));
  const Triangles mesh = readPly(file(part(about.at("displaced_mesh").at("file"))));
  const auto pixels = static_cast<std::size_t>(drawn.width) * std::size_t(drawn.height);
  const std::vector<Point> directions =
      towardDisc(pointOf(about.at("lights").at(0).at("direction")), 8 * 3.14159265358979 / 180, 6);
  std::vector<double> seen(pixels, 0);
  for (const Point& direction : directions) {
    const SunRays rays(mesh, direction);
    for (std::size_t i = 0; i < pixels; ++i) {
      const Point facet = drawn.point("facet", i);
      if (dot(facet, direction) <= 0) continue;
      Point origin = drawn.point("point", i);
      for (std::size_t k = 0; k < 3; ++k) origin.at(k) += 0.05 * facet.at(k);
      seen[i] += rays.blocked(origin) ? 0 : 1.0 / double(directions.size());
    }
  }
  double sum = 0;
  std::size_t count = 0, between = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    const Point facet = drawn.point("facet", i);
    ASSERT_EQ(shares.of.at("A")[i] == 0, dot(facet, facet) == 0) << i;
    if (shares.of.at("A")[i] == 0) continue;
    const double share = shares.of.at("V")[i];
    sum += std::abs(share - seen[i]);
    between += share > 0 && share < 1 ? 1 : 0;
    ++count;
  }
  EXPECT_LT(sum / double(count), 0.01);
  EXPECT_GT(between, count / 20) << "else masks would do as well";
  EXPECT_FALSE(view.at("drawn").at("masks").at(1).contains("shares")) << "a point";
}

// That of the pixels that the camera draws, by the rule of the samples', not that of the samples.
TEST_F(ExportDrawn, WhatACameraDrawsHasAnUncertaintyOfItsOwn) {
  const nlohmann::json about = aboutOf("soft");
  const nlohmann::json& view = about.at("views").at(0);
  for (std::size_t l = 0; l < 2; ++l) {
    const nlohmann::json& mask = view.at("drawn").at("masks").at(l);
    const double own = mask.at("uncertainty");
    const double samples = view.at("masks").at(l).at("uncertainty");
    EXPECT_GT(own, samples / 4);
    EXPECT_LT(own, samples * 4);
    EXPECT_NE(own, samples);
    std::vector<std::string> files = {mask.at("truth")};
    if (mask.contains("shares")) files.push_back(mask.at("shares"));
    for (const std::string& name : files) {
      const std::string path = "out/soft/export/" + name;
      const Outcome outcome = gnomon({"compare", path, path, "--json", "-"});
      ASSERT_EQ(outcome.status, 0) << outcome.err;
      EXPECT_EQ(nlohmann::json::parse(outcome.out).at("uncertainty"), own) << name;
    }
  }
}

bool hasBlender() {
  return std::system("blender --version > /dev/null 2>&1") == 0;  // NOLINT(cert-env33-c)
}

class Blender : public EndToEnd {
 protected:
  void SetUp() override {
    if (!hasBlender()) GTEST_SKIP() << "Blender is not installed: apt install blender";
    EndToEnd::SetUp();
  }
  /// Runs the script on an export; its masks are in `back`.
  [[nodiscard]] int blender(const std::string& exported) const {
    const std::string script = GNOMON_DOCS "/blender.py";
    return endOf(startCommand(
        folder(),
        {"blender", "-b", "--factory-startup", "-P", script, "--", exported, "back", "--pictures"},
        {}, file("out.txt"), file("err.txt")));
  }
  [[nodiscard]] nlohmann::json compared(const std::string& mine, const std::string& truth) const {
    const Outcome outcome = gnomon({"compare", mine, truth, "--json", "-"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out);
  }
};

/// Figure 8's patch at a quarter of the view's side.
TEST_F(Blender, GivesTheMasksOfFigure8BackAsAMethod) {
  const std::string study =
      replaced(read(GNOMON_SCENES "/figure8.toml"), "[study]", "[study]\nquick = true");
  write("figure8.toml", study);
  ASSERT_EQ(gnomon({"export", "figure8.toml"}).status, 0);
  const std::string exported = "out/figure8/export";
  ASSERT_EQ(blender(exported), 0) << read("out.txt") << read("err.txt");
  const nlohmann::json all = compared("back/masks", exported + "/masks").at("all");
  EXPECT_GT(all.at("samples"), 20000);
  EXPECT_LE(all.at("error_rate"), all.at("uncertainty"));
  // Cycles sees other points, by its own rays.
  EXPECT_LE(compared("back/drawn", exported + "/drawn/masks").at("all").at("error_rate"), 0.003);
  write("figure8.toml", study + "\n[[method]]\nmasks = \"back/masks\"\nlabel = \"blender\"\n");
  const Outcome run = gnomon({"run", "figure8.toml", "--method", "blender"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(resultOf(summary("figure8"), "blender", "elevation 24° azimuth 165°", "camera")
                .at("error_rate"),
            all.at("error_rate"));
}

}  // namespace
}  // namespace gnomon::test
