#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "image/images.h"
#include "study/spec/resolved_study.h"
#include "study/spec/study_file.h"
#include "study/spec/study_file_fixture.h"
#include "study/spec/sweep/sweep.h"
#include "support/scene_files.h"
#include "truth/visibility_tracer.h"

// `[[light]] radius` and `sun`, `[truth] directions` and `[[method]] disc`.

namespace gnomon::study {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// ---- what a study says

TEST_F(StudyFile, HoldsWhatItSays) {
  const StudySpec study = read(plainStudy);
  EXPECT_EQ(study.name, "plain");
  EXPECT_EQ(study.title, "Columns on a plane");
  EXPECT_EQ(study.source, "a test");
  EXPECT_EQ(study.relief.field.width(), 64);
  EXPECT_EQ(study.relief.field.height(), 32);
  EXPECT_EQ(study.relief.space, relief::HeightSpace::world);
  ASSERT_EQ(study.views.size(), 2U);
  const Camera& camera = std::get<Camera>(study.views[0].kind);
  EXPECT_EQ(study.views[0].name, "camera");
  EXPECT_EQ(camera.width, 200);
  EXPECT_EQ(camera.eye, Vec3(0, 0, 90));
  EXPECT_EQ(study.views[1].name, "atlas");
  EXPECT_EQ(std::get<AtlasSpec>(study.views[1].kind).samplesPerSide, 8);
  ASSERT_EQ(study.methods.size(), 2U);
  EXPECT_EQ(study.methods[0].label, "max-forsyth");
  EXPECT_EQ(study.methods[1].label, "ours");
  EXPECT_EQ(study.methods[1].file.filename(), "onoue-2004.glsl");
}

TEST_F(StudyFile, SearchesOccludersAsFarAsTheLongestShadowUnlessTold) {
  const StudySpec study = read(plainStudy);
  EXPECT_EQ(study.bake.settings.radiusTexels, std::ceil(4 / std::tan(radians(30.0))));
  EXPECT_EQ(study.methods[0].bake.settings.radiusTexels, study.bake.settings.radiusTexels);
  EXPECT_EQ(study.radius.bound, horizon::RadiusBound::leaves);
  // The longest of all lights.
  EXPECT_EQ(readWith({"light.0.elevation=[60, 15]"}).bake.settings.radiusTexels,
            std::ceil(4 / std::tan(radians(15.0))));
  const StudySpec stated = readWith({"bake.radius=12.5"});
  EXPECT_EQ(stated.bake.settings.radiusTexels, 12.5);
  EXPECT_EQ(stated.radius.bound, horizon::RadiusBound::stated);
  EXPECT_EQ(stated.radius.texels, 12.5);
}

TEST_F(StudyFile, EndsAMapWithAnOpenPatch) {
  EXPECT_EQ(read(plainStudy).relief.field.border(), (relief::Border{true, true}));
  EXPECT_EQ(readWith({"relief.repeats=[2, 1]"}).relief.field.border(),
            (relief::Border{false, true}));
}

TEST_F(StudyFile, WrapsAndRepeatsOnceUnlessTold) {
  const StudySpec standard = read(plainStudy);
  EXPECT_EQ(standard.relief.field.wrap(), relief::Wrap::repeat);
  EXPECT_EQ(standard.relief.repeats, Vec2(1));
  const StudySpec told = readWith({"relief.wrap=clamp", "relief.repeats=[2, 3.5]"});
  EXPECT_EQ(told.relief.field.wrap(), relief::Wrap::clamp);
  EXPECT_EQ(told.relief.repeats, Vec2(2, 3.5));
}

TEST_F(StudyFile, ReadsAHeightImageBesideIt) {
  image::writeExr(file("map.exr"), image::ChannelImage{2, 1, {"Y"}, {0.25F, 1.0F}});
  const StudySpec study = readWith({R"(relief={image="map.exr", height=8, height_space="world"})"});
  EXPECT_EQ(study.relief.field.width(), 2);
  EXPECT_EQ(study.relief.field.texel(0, 0), 2);
  EXPECT_EQ(study.relief.field.texel(1, 0), 8);
}

// ---- lights

TEST_F(StudyFile, LightsPointWhereTheyAreSaidTo) {
  const StudySpec study = readWith({"light.0.azimuth=90", "light.0.elevation=30"});
  const Vec3 direction = study.lights.at(0).direction;
  EXPECT_NEAR(glm::length(direction - Vec3(0, std::sqrt(0.75), 0.5)), 0, 1e-15);
  EXPECT_NEAR(glm::length(readWith({"light.0.elevation=90"}).lights[0].direction - Vec3(0, 0, 1)),
              0, 1e-15);
}

TEST_F(StudyFile, ASweepIsEveryElevationWithEveryAzimuth) {
  const StudySpec study =
      readWith({"light.0.azimuth=[0, 120, 240]", "light.0.elevation=[60, 12.5]"});
  ASSERT_EQ(study.lights.size(), 6U);
  EXPECT_EQ(study.lights[0].name, "elevation 60° azimuth 0°");
  EXPECT_EQ(study.lights[1].name, "elevation 12.5° azimuth 0°");
  EXPECT_EQ(study.lights[5].name, "elevation 12.5° azimuth 240°");
  EXPECT_NEAR(study.lights[5].angles.azimuth, 240, 1e-15);
  EXPECT_NEAR(study.lights[5].angles.elevation, 12.5, 1e-15);
}

TEST_F(StudyFile, OneLightMayHaveAName) {
  EXPECT_EQ(readWith({"light.0.name=dusk"}).lights.at(0).name, "dusk");
  EXPECT_EQ(readWith({"light.0.name=dusk", "light.0.elevation=[30]"}).lights.at(0).name, "dusk");
  EXPECT_THAT(
      failureWith({"light.0.name=dusk", "light.0.elevation=[30, 20]"}),
      HasSubstr("light.0.name: a name found for several lights, which are named by their angles"));
}

// ---- methods

TEST_F(StudyFile, MethodsOverrideTheStudysBakeAndBase) {
  const StudySpec study = readWith(
      {"bake={azimuths=16, bits=16, radius=20}", "base.subdivisions=3", "method.1.bake.azimuths=4",
       "method.1.base.subdivisions=2", "method.1.filter=hardware", "method.1.name=relief-march",
       "method.1.parameters.steps=7", "base.curvature=vertices", "method.1.base.curvature=limit"});
  const MethodSpec& first = study.methods[0];
  EXPECT_EQ(first.bake.settings.azimuths, 16);
  EXPECT_EQ(first.bake.bits, horizon::TableBits::sixteen);
  EXPECT_EQ(first.base.subdivisions, 3);
  EXPECT_EQ(first.base.curvature, surface::CurvatureSource::vertices);
  EXPECT_EQ(first.filter, render::TableFilter::exact);
  EXPECT_TRUE(first.parameters.empty());
  const MethodSpec& second = study.methods[1];
  EXPECT_EQ(second.bake.settings.azimuths, 4);
  EXPECT_EQ(second.bake.settings.radiusTexels, 20);
  EXPECT_EQ(second.bake.bits, horizon::TableBits::sixteen);
  EXPECT_EQ(second.base.subdivisions, 2);
  EXPECT_EQ(second.base.curvature, surface::CurvatureSource::limit);
  EXPECT_EQ(second.filter, render::TableFilter::hardware);
  EXPECT_EQ(second.parameters, (std::map<std::string, double>{{"steps", 7}}));
}

TEST_F(StudyFile, AMethodMayBeAFileBesideIt) {
  fs::create_directory(folder() / "own");
  std::ofstream(folder() / "own/mine.glsl")
      << "/* gnomon-method\ntitle = \"T\"\ncitation = \"C\"\nazimuths = 8\nsubdivisions = 5\n*/\n"
         "bool isShadowed(Pixel pixel, LocalLight light) { return false; }\n";
  const StudySpec study = readWith(
      {R"(method=[{file="own/mine.glsl"},{file="own/mine.glsl",label="b",bake={azimuths=12}}])"});
  EXPECT_EQ(study.methods[0].file, folder() / "own/mine.glsl");
  EXPECT_EQ(study.methods[0].label, "mine");
  // What its authors state comes before the study's own, and an override before that.
  EXPECT_EQ(study.methods[0].bake.settings.azimuths, 8);
  EXPECT_EQ(study.methods[0].base.subdivisions, 5);
  EXPECT_EQ(study.methods[1].bake.settings.azimuths, 12);
}

TEST_F(StudyFile, StudiesThatShareTheirPartsReadAMethodOnce) {
  std::ofstream(file("mine.glsl"))
      << "/* gnomon-method\ntitle = \"T\"\ncitation = \"C\"\nazimuths = 12\n*/\n"
         "bool isShadowed(Pixel pixel, LocalLight light) { return false; }\n";
  const StudyText text{file("plain.toml"), plainStudy + "[[method]]\nfile = \"mine.glsl\"\n"};
  const auto azimuthsWith = [&](StudyParts& parts) {
    return readStudy(text, {}, parts).methods.back().bake.settings.azimuths;
  };
  StudyParts parts;
  EXPECT_EQ(azimuthsWith(parts), 12);
  std::ofstream(file("mine.glsl")) << "no method";
  EXPECT_EQ(azimuthsWith(parts), 12);
  StudyParts others;
  EXPECT_THROW((void)azimuthsWith(others), InputError);
}

TEST_F(StudyFile, OnlyTheMethodsAskedForStay) {
  const std::string text = plainStudy + R"(
[[threshold]]
method = "max-forsyth"
max = 0.5
[[threshold]]
method = "ours"
max = 0.1
[[threshold]]
max = 0.9
[[claim]]
text = "better"
source = "here"
less = "ours"
than = "max-forsyth"
)";
  const StudySpec byLabel = read(text, {{}, {"ours"}, false});
  ASSERT_EQ(byLabel.methods.size(), 1U);
  EXPECT_EQ(byLabel.methods[0].label, "ours");
  EXPECT_TRUE(byLabel.claims.empty());
  ASSERT_EQ(byLabel.thresholds.size(), 2U);
  EXPECT_EQ(byLabel.thresholds[0].method, "ours");
  EXPECT_EQ(byLabel.thresholds[1].method, "");
  EXPECT_EQ(read(text, {{}, {"onoue-2004"}, false}).methods.at(0).label, "ours") << "by its name";
  EXPECT_EQ(read(text, {{}, {"ours", "max-forsyth"}, false}).claims.size(), 1U);
  EXPECT_THAT(failure<UsageError>(text, {{}, {"ours", "ous"}, false}),
              StartsWith("--method ous: plain.toml has max-forsyth, ours"));
}

// ---- quick

TEST_F(StudyFile, QuickIsAQuarterOfTheSidesAndASixteenthOfTheMesh) {
  const StudySpec full = read(plainStudy);
  const StudySpec quick =
      read(plainStudy, {{"truth.step=0.125", "view.0.height=3", "study.frames=25"}, {}, true});
  EXPECT_EQ(std::get<Camera>(quick.views[0].kind).width, 50);
  EXPECT_EQ(std::get<Camera>(quick.views[0].kind).height, 1) << "never none";
  EXPECT_EQ(std::get<AtlasSpec>(quick.views[1].kind).samplesPerSide, 3)
      << "odd, near a quarter of 8";
  EXPECT_EQ(quick.frames, 0);
  EXPECT_EQ(quick.truth.stepTexels, 0.5);
  EXPECT_EQ(16 * quick.truth.leastTriangles, full.truth.leastTriangles);
  EXPECT_FALSE(full.truth.stepTexels);
}

// ---- the studies that come with the program

TEST(Scenes, CanAllBeRead) {
  int count = 0;
  for (const fs::path& path : test::sceneFiles(GNOMON_SCENES)) {
    ++count;
    StudySpec study = readStudy(path);
    EXPECT_EQ(study.name, path.stem().string());
    EXPECT_FALSE(study.claims.empty() && study.thresholds.empty()) << path;
  }
  EXPECT_GE(count, 3);
}

using SoftLight = StudyFile;

TEST_F(SoftLight, HasARadiusInItsName) {
  const Light light = readWith({"light.0.radius=0.5"}).lights.front();
  EXPECT_EQ(light.radius, radians(0.5));
  EXPECT_TRUE(light.isSoft());
  EXPECT_EQ(light.name, "elevation 30° azimuth 20° radius 0.5°");
  const Light point = read(plainStudy).lights.front();
  const Light zero = readWith({"light.0.radius=0"}).lights.front();
  EXPECT_FALSE(zero.isSoft());
  EXPECT_EQ(zero.name, point.name);
  EXPECT_EQ(truth::lowestOfDisc(zero), point.direction);
}

TEST_F(SoftLight, OfTheSunHasItsRadius) {
  const Light light = readWith({"light.0.sun=true"}).lights.front();
  EXPECT_EQ(light.radius, radians(0.266));
  EXPECT_FALSE(readWith({"light.0.sun=false"}).lights.front().isSoft());
  EXPECT_THAT(failureWith({"light.0.sun=true", "light.0.radius=1"}),
              AllOf(HasSubstr("light.0.sun"), HasSubstr("one of the two expected")));
  EXPECT_THAT(failureWith({"light.0.radius=11"}),
              AllOf(HasSubstr("light.0.radius"), HasSubstr("at least 0 and at most 10")));
  EXPECT_THAT(failureWith({"light.0.radius=-1"}), HasSubstr("light.0.radius"));
}

TEST_F(SoftLight, ReachesAsFarAsItsLowestPoint) {
  const StudySpec point = read(plainStudy);
  const StudySpec disc = readWith({"light.0.radius=5"});
  EXPECT_NEAR(std::asin(truth::lowestOfDisc(disc.lights.front()).z), radians(25), 1e-12);
  EXPECT_GT(disc.radius.texels, point.radius.texels);
}

TEST_F(SoftLight, IsWrittenAsItIsRead) {
  const auto written = [&](const StudySpec& study) {
    return *resolvedStudy(study, file("").parent_path())["light"].as_array()->front().as_table();
  };
  EXPECT_FALSE(written(read(plainStudy)).contains("radius"));
  const toml::table sun = written(readWith({"light.0.sun=true"}));
  EXPECT_EQ(sun["radius"].value<double>(), 0.266);
  EXPECT_FALSE(sun.contains("sun"));
}

TEST_F(SoftLight, IsTracedTowardAnEvenNumberOfDirections) {
  EXPECT_EQ(read(plainStudy).truth.directions, 256);
  EXPECT_EQ(readWith({"truth.directions=64"}).truth.directions, 64);
  EXPECT_THAT(failureWith({"truth.directions=65"}),
              AllOf(HasSubstr("truth.directions"), HasSubstr("an even number expected")));
  EXPECT_THAT(failureWith({"truth.directions=16"}), HasSubstr("32 to 65536"));
}

TEST_F(SoftLight, MayBeHeldAgainstAHorizon) {
  const StudySpec study = readWith({"method.0.disc=true"});
  EXPECT_TRUE(study.methods.front().disc);
  EXPECT_EQ(study.methods.front().label, "max-forsyth + disc");
  EXPECT_FALSE(study.methods.back().disc);
  EXPECT_FALSE(isSameMethod(study.methods.front(), read(plainStudy).methods.front()));
  EXPECT_THAT(failureWith({"method.0.name='unshadowed'", "method.0.disc=true"}),
              AllOf(HasSubstr("method.0.disc"), HasSubstr("horizonSlope")));
}

TEST_F(SoftLight, AMethodHeldAgainstItIsCalledSoByOptionsToo) {
  std::ofstream(file("two.toml")) << plainStudy << R"(
[[method]]
name = "onoue-2004"
[[method]]
name = "onoue-2004"
disc = true
)";
  StudyOptions options;
  options.replacements = {"onoue-2004 + disc=max-forsyth"};
  const StudySpec study = readStudy(file("two.toml"), options);
  const std::size_t last = study.methods.size() - 1;
  EXPECT_EQ(study.methods.at(last).label, "onoue-2004 + disc");
  EXPECT_EQ(study.methods.at(last).file.stem(), "max-forsyth");
  EXPECT_EQ(study.methods.at(last - 1).file.stem(), "onoue-2004");
}

TEST_F(SoftLight, IsSwept) {
  std::ofstream(file("plain.toml"), std::ios::binary)
      << plainStudy + "[[sweep]]\nkey = \"light.0.radius\"\nvalues = [0, 0.5, 5]\n";
  const StudyPlan plan = readStudyPlan(file("plain.toml"));
  ASSERT_EQ(plan.steps.size(), 3U);
  EXPECT_FALSE(plan.steps[0].lights.front().isSoft());
  EXPECT_EQ(plan.steps[2].lights.front().radius, radians(5));
}

}  // namespace
}  // namespace gnomon::study
