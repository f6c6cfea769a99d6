#include "study/study_file.h"

#include <array>
#include <fstream>

#include "common/error.h"
#include "image_files/image_library.h"
#include "support/error_messages.h"
#include "support/replaced.h"
#include "support/temporary_folder.h"

namespace gnomon {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr const char* plainStudy = R"([study]
name = "plain"
title = "Columns on a plane"
source = "a test"

[surface]
shape = "plane"
quads = [4, 2]
size = [64, 32]

[relief]
pattern = "columns"
texels = [64, 32]
height = 4
height_space = "world"

[[view]]
type = "camera"
width = 200
height = 100
eye = [0, 0, 90]

[[view]]
type = "atlas"
samples = 8

[[light]]
azimuth = 20
elevation = 30

[[method]]
name = "max-forsyth"

[[method]]
name = "onoue-2004"
label = "ours"
)";

class StudyFile : public TemporaryFolder {
 protected:
  StudySpec read(const std::string& text, const StudyOptions& options = {}) {
    std::ofstream(file("plain.toml"), std::ios::binary) << text;
    return readStudy(file("plain.toml"), options);
  }
  StudySpec readWith(std::vector<std::string> overrides) {
    return read(plainStudy, {std::move(overrides), {}, false});
  }
  /// The error's message, without the folder.
  template <typename ErrorType = InputError>
  std::string failure(const std::string& text, const StudyOptions& options = {}) {
    std::string message = messageOf<ErrorType>([&] { (void)read(text, options); });
    const std::string prefix = folder().string() + "/";
    for (std::size_t at = 0; (at = message.find(prefix)) != std::string::npos;) {
      message.erase(at, prefix.size());
    }
    return message;
  }
  std::string failureWith(std::vector<std::string> overrides) {
    return failure(plainStudy, {std::move(overrides), {}, false});
  }
  std::string failureOf(const std::string& from, const std::string& to) {
    return failure(test::replaced(plainStudy, from, to));
  }
};

// ---- what a study says

TEST_F(StudyFile, HoldsWhatItSays) {
  const StudySpec study = read(plainStudy);
  EXPECT_EQ(study.name, "plain");
  EXPECT_EQ(study.title, "Columns on a plane");
  EXPECT_EQ(study.source, "a test");
  EXPECT_EQ(study.relief.field.width(), 64);
  EXPECT_EQ(study.relief.field.height(), 32);
  EXPECT_EQ(study.relief.space, HeightSpace::world);
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

TEST_F(StudyFile, SearchesOccludersOverTheLongerSideUnlessTold) {
  EXPECT_EQ(read(plainStudy).bake.settings.radiusTexels, 64);
  EXPECT_EQ(readWith({"bake.radius=12.5"}).bake.settings.radiusTexels, 12.5);
}

TEST_F(StudyFile, WrapsAndRepeatsOnceUnlessTold) {
  const StudySpec standard = read(plainStudy);
  EXPECT_EQ(standard.relief.field.wrap(), Wrap::repeat);
  EXPECT_EQ(standard.relief.repeats, Vec2(1));
  const StudySpec told = readWith({"relief.wrap=clamp", "relief.repeats=[2, 3.5]"});
  EXPECT_EQ(told.relief.field.wrap(), Wrap::clamp);
  EXPECT_EQ(told.relief.repeats, Vec2(2, 3.5));
}

TEST_F(StudyFile, EveryShapeAndPatternCanBeAskedFor) {
  for (const char* shape :
       {R"({shape="plane", quads=[2, 3], size=[9, 9]})",
        R"({shape="cylinder", quads=[12, 2], size=[9, 9], curvature=0.1})",
        R"({shape="sphere", quads=[20, 20], size=[9, 9], curvature=0.1})",
        R"({shape="torus", quads=[60, 80], major=4, minor=1})",
        R"({shape="b-spline", columns=4, points=[[0,0,0],[1,0,0],[2,0,0],[3,0,0],[0,1,0],[1,1,0],)"
        R"([2,1,0],[3,1,0],[0,2,0],[1,2,0],[2,2,0],[3,2,0],[0,3,0],[1,3,0],[2,3,0],[3,3,0]]})"}) {
    EXPECT_FALSE(readWith({std::string("surface=") + shape}).cage.faceVertices.empty()) << shape;
  }
  for (const char* pattern :
       {R"(pattern="columns", radius=3, wall=2, period=8)", R"(pattern="cosine", period=8)",
        R"(pattern="cells", period=8, jitter=0.5, groove=1, seed=3)",
        R"(pattern="ripples", period=8, windward=0.7, meander=2)"}) {
    const StudySpec study = readWith({std::string("relief={texels=[16, 16], height=5, "
                                                  "height_space=\"texture\", ") +
                                      pattern + "}"});
    EXPECT_GT(study.relief.field.maximum(), 2) << pattern;
    EXPECT_LE(study.relief.field.maximum(), 5) << pattern;
  }
}

TEST_F(StudyFile, ReadsAHeightImageBesideIt) {
  const std::array<float, 2> heights = {0.25F, 1.0F};
  const auto image =
      imageLibrary().createExr(file("map.exr"), {2, 1, {"Y"}, NumberType::float32, {}});
  image->writeRows(0, 1, NumberType::float32, heights.data());
  image->close();
  const StudySpec study = readWith({R"(relief={image="map.exr", height=8, height_space="world"})"});
  EXPECT_EQ(study.relief.field.width(), 2);
  EXPECT_EQ(study.relief.field.texel(0, 0), 2);
  EXPECT_EQ(study.relief.field.texel(1, 0), 8);
}

// ---- lights

TEST_F(StudyFile, LightsPointWhereTheyAreSaidTo) {
  const StudySpec study = readWith({"light.0.azimuth=90", "light.0.elevation=30"});
  const Vec3 direction = study.lights.at(0).direction();
  EXPECT_NEAR(glm::length(direction - Vec3(0, std::sqrt(0.75), 0.5)), 0, 1e-15);
  EXPECT_NEAR(glm::length(readWith({"light.0.elevation=90"}).lights[0].direction() - Vec3(0, 0, 1)),
              0, 1e-15);
}

TEST_F(StudyFile, ASweepIsEveryElevationWithEveryAzimuth) {
  const StudySpec study =
      readWith({"light.0.azimuth=[0, 120, 240]", "light.0.elevation=[60, 12.5]"});
  ASSERT_EQ(study.lights.size(), 6U);
  EXPECT_EQ(study.lights[0].name, "elevation 60° azimuth 0°");
  EXPECT_EQ(study.lights[1].name, "elevation 12.5° azimuth 0°");
  EXPECT_EQ(study.lights[5].name, "elevation 12.5° azimuth 240°");
  EXPECT_NEAR(study.lights[5].azimuth, radians(240), 1e-15);
  EXPECT_NEAR(study.lights[5].elevation, radians(12.5), 1e-15);
}

TEST_F(StudyFile, OneLightMayHaveAName) {
  EXPECT_EQ(readWith({"light.0.name=dusk"}).lights.at(0).name, "dusk");
  EXPECT_EQ(readWith({"light.0.name=dusk", "light.0.elevation=[30]"}).lights.at(0).name, "dusk");
  EXPECT_THAT(failureWith({"light.0.name=dusk", "light.0.elevation=[30, 20]"}),
              HasSubstr("light.0.name: a sweep of lights names itself"));
}

// ---- methods

TEST_F(StudyFile, MethodsOverrideTheStudysBakeAndBase) {
  const StudySpec study = readWith({"bake={azimuths=16, bits=16, radius=20}", "base.subdivisions=3",
                                    "method.1.bake.azimuths=4", "method.1.base.subdivisions=2",
                                    "method.1.filter=hardware", "method.1.parameters.steps=7",
                                    "base.curvature=vertices", "method.1.base.curvature=limit"});
  const MethodSpec& first = study.methods[0];
  EXPECT_EQ(first.bake.settings.azimuths, 16);
  EXPECT_EQ(first.bake.bits, TableBits::sixteen);
  EXPECT_EQ(first.baseSubdivisions, 3);
  EXPECT_EQ(first.baseCurvature, CurvatureSource::vertices);
  EXPECT_EQ(first.filter, TableFilter::exact);
  EXPECT_TRUE(first.parameters.empty());
  const MethodSpec& second = study.methods[1];
  EXPECT_EQ(second.bake.settings.azimuths, 4);
  EXPECT_EQ(second.bake.settings.radiusTexels, 20);
  EXPECT_EQ(second.bake.bits, TableBits::sixteen);
  EXPECT_EQ(second.baseSubdivisions, 2);
  EXPECT_EQ(second.baseCurvature, CurvatureSource::limit);
  EXPECT_EQ(second.filter, TableFilter::hardware);
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
  EXPECT_EQ(study.methods[0].baseSubdivisions, 5);
  EXPECT_EQ(study.methods[1].bake.settings.azimuths, 12);
}

TEST_F(StudyFile, OnlyTheMethodsAskedForStay) {
  const std::string text = std::string(plainStudy) + R"(
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
  const StudySpec quick = read(plainStudy, {{"truth.step=0.125", "view.0.height=3"}, {}, true});
  EXPECT_EQ(std::get<Camera>(quick.views[0].kind).width, 50);
  EXPECT_EQ(std::get<Camera>(quick.views[0].kind).height, 1) << "never none";
  EXPECT_EQ(std::get<AtlasSpec>(quick.views[1].kind).samplesPerSide, 3)
      << "odd, near a quarter of 8";
  EXPECT_EQ(quick.truth.stepTexels, 0.5);
  EXPECT_EQ(16 * quick.truth.leastTriangles, full.truth.leastTriangles);
  EXPECT_FALSE(full.truth.stepTexels);
  const StudySpec wanted = read(plainStudy, {{"truth.uncertainty=0.001"}, {}, true});
  EXPECT_EQ(wanted.truthUncertainty, 0.004) << "four times the step is as much less certain";
}

TEST_F(StudyFile, TheTruthHasAStepOrAnUncertainty) {
  EXPECT_FALSE(read(plainStudy).truthUncertainty);
  EXPECT_EQ(readWith({"truth.uncertainty=0.001"}).truthUncertainty, 0.001);
  EXPECT_EQ(failure(std::string(plainStudy) + "[truth]\nstep = 0.25\nuncertainty = 0.001\n"),
            "plain.toml:39: truth.uncertainty: `step` found beside it, one of the two expected");
  EXPECT_THAT(failureWith({"truth.uncertainty=0"}), HasSubstr("truth.uncertainty: 0 found"));
  EXPECT_THAT(failureWith({"truth.uncertainty=2"}), HasSubstr("truth.uncertainty: 2 found"));
}

// ---- gates and claims

TEST_F(StudyFile, AGateHasItsFilters) {
  const StudySpec study = read(std::string(plainStudy) + R"(
[[threshold]]
method = "ours"
light = "elevation 30° azimuth 20°"
view = "atlas"
region = "cast"
metric = "false_light"
min = 0
max = 0.05
[[threshold]]
max = 0.1
)");
  ASSERT_EQ(study.thresholds.size(), 2U);
  EXPECT_EQ(study.thresholds[0].region, "cast");
  EXPECT_EQ(study.thresholds[0].minimum, 0);
  EXPECT_EQ(study.thresholds[0].maximum, 0.05);
  EXPECT_EQ(study.thresholds[1].method, "");
  EXPECT_EQ(study.thresholds[1].region, "all");
  EXPECT_EQ(study.thresholds[1].metric, "error_rate");
  EXPECT_FALSE(study.thresholds[1].minimum);
}

TEST_F(StudyFile, AFilterThatMatchesNothingIsAFault) {
  const auto refused = [&](const std::string& line) {
    return failure(std::string(plainStudy) + "\n[[threshold]]\nmax = 0.1\n" + line);
  };
  EXPECT_EQ(refused("method = \"onoue-2004\"\n"),
            "plain.toml:40: threshold.0.method: \"onoue-2004\" found, one of max-forsyth, ours "
            "expected");
  EXPECT_THAT(refused("light = \"noon\"\n"),
              HasSubstr("threshold.0.light: \"noon\" found, one of elevation 30° azimuth 20°"));
  EXPECT_THAT(refused("view = \"front\"\n"), HasSubstr("one of camera, atlas expected"));
  EXPECT_THAT(
      refused("region = \"dark\"\n"),
      HasSubstr("one of all, lit, attached, cast, distant, beyond-terminator, seam expected"));
  EXPECT_THAT(refused("metric = \"accuracy\"\n"),
              AllOf(HasSubstr("\"accuracy\" found, one of error_rate"), HasSubstr("mcc")));
  EXPECT_THAT(refused("method = \"\"\n"), HasSubstr("a string that is not empty expected"));
  EXPECT_THAT(refused("maximum = 3\n"), HasSubstr("threshold.0.maximum: unknown key"));
}

TEST_F(StudyFile, AGateNeedsALimit) {
  EXPECT_THAT(failure(std::string(plainStudy) + "\n[[threshold]]\nmetric = \"iou\"\n"),
              HasSubstr("threshold.0.max: `max` or `min` expected"));
  EXPECT_THAT(failure(std::string(plainStudy) + "\n[[threshold]]\nmax = nan\n"),
              HasSubstr("nan found, a finite number expected"));
}

TEST_F(StudyFile, AClaimNamesTwoMethods) {
  const std::string claim =
      std::string(plainStudy) + "\n[[claim]]\ntext = \"t\"\nsource = \"s\"\nless = \"ours\"\n";
  const StudySpec study = read(claim + "than = \"max-forsyth\"\ngain_exceeds = \"flat\"\n");
  ASSERT_EQ(study.claims.size(), 1U);
  EXPECT_EQ(study.claims[0].gainExceeds, "flat");
  EXPECT_EQ(study.claims[0].metric, "error_rate");
  EXPECT_THAT(failure(claim), HasSubstr("claim.0.than: missing"));
  EXPECT_THAT(failure(claim + "than = \"theirs\"\n"),
              HasSubstr("\"theirs\" found, one of max-forsyth, ours expected"));
}

TEST_F(StudyFile, AClaimMayPutOneMethodBetweenBounds) {
  const std::string claim = std::string(plainStudy) + "\n[[claim]]\ntext = \"t\"\nsource = \"s\"\n";
  const StudySpec study = read(claim + R"(method = "ours"
metric = "shadow_length_ratio"
region = "beyond-terminator"
above = 0.95
below = 1.05
)");
  ASSERT_EQ(study.claims.size(), 1U);
  EXPECT_EQ(study.claims[0].method, "ours");
  EXPECT_EQ(study.claims[0].metric, "shadow_length_ratio");
  EXPECT_EQ(study.claims[0].region, "beyond-terminator");
  EXPECT_EQ(study.claims[0].above, 0.95);
  EXPECT_EQ(study.claims[0].below, 1.05);
  EXPECT_EQ(study.claims[0].less, "");
  const StudySpec oneSided = read(claim + "method = \"ours\"\nabove = 1\n");
  EXPECT_EQ(oneSided.claims.at(0).below, std::nullopt);
  EXPECT_EQ(oneSided.claims.at(0).region, "all");
  EXPECT_TRUE(
      read(claim + "method = \"ours\"\nabove = 1\n", {{}, {"max-forsyth"}, false}).claims.empty());

  EXPECT_THAT(failure(claim + "method = \"theirs\"\nabove = 1\n"),
              HasSubstr("\"theirs\" found, one of max-forsyth, ours expected"));
  EXPECT_THAT(failure(claim + "method = \"ours\"\n"),
              HasSubstr("claim.0.above: `above` or `below` expected"));
  EXPECT_THAT(failure(claim + "method = \"ours\"\nabove = 2\nbelow = 1\n"),
              HasSubstr("claim.0.below: 1 found, more than `above` = 2 expected"));
  EXPECT_THAT(failure(claim + "above = 1\n"), HasSubstr("less"));
  EXPECT_THAT(failure(claim + "method = \"ours\"\nless = \"ours\"\nabove = 1\n"),
              HasSubstr("method"));
  EXPECT_THAT(failure(claim + "method = \"ours\"\nthan = \"ours\"\nabove = 1\n"),
              HasSubstr("claim.0.than: unknown key"));
  EXPECT_THAT(failure(claim + "less = \"ours\"\nthan = \"ours\"\nregion = \"dark\"\n"),
              HasSubstr("\"dark\" found, one of all, lit"));
}

// ---- errors, section by section

struct Refusal {
  const char* change;  ///< an override
  const char* message;
};

TEST_F(StudyFile, RefusesWhatItCannotUse) {
  const Refusal refusals[] = {
      // unknown keys, in every section
      {"extra=1", "extra: unknown key, expected bake, base, claim, ladder"},
      {"study.titel=x", "study.titel: unknown key, expected name, ranked, source, title"},
      {"surface.sise=[1, 1]", "surface.sise: unknown key"},
      {"surface.curvature=0.1", "surface.curvature: unknown key"},
      {"relief.amplitude=1", "relief.amplitude: unknown key"},
      {"relief.jitter=1", "relief.jitter: unknown key, expected height, height_space"},
      {"bake.azimuth=1", "bake.azimuth: unknown key, expected azimuths, bits, limit, radius"},
      {"base.subdivision=1", "base.subdivision: unknown key, expected curvature, subdivisions"},
      {"truth.steps=1", "truth.steps: unknown key, expected step"},
      {"view.0.samples=3", "view.0.samples: unknown key"},
      {"view.1.width=3", "view.1.width: unknown key"},
      {"light.0.elevations=3", "light.0.elevations: unknown key"},
      {"method.0.title=x", "method.0.title: unknown key"},
      {"method.0.bake.texels=3", "method.0.bake.texels: unknown key"},
      {"method.0.base.levels=3", "method.0.base.levels: unknown key"},
      // wrong types
      {"study.name=3", "study.name: 3 found, a string that is not empty expected"},
      {"study.title=\"\"", "study.title: the string \"\" found"},
      {"surface.quads=4", "surface.quads: 4 found, a list of 2 numbers expected"},
      {"surface.quads=[4, 2.5]", "surface.quads: [4, 2.5] found, two whole numbers expected"},
      {"surface.size=[1, 2, 3]", "surface.size: a list of 3 found, a list of 2 numbers expected"},
      {"relief.texels=[64.5, 3]", "relief.texels: [64.5, 3] found, two whole numbers expected"},
      {"relief.height=tall", "relief.height: the string \"tall\" found"},
      {"bake.azimuths=32.0", "bake.azimuths: 32 found, a whole number from 1 to 1024 expected"},
      {"view.0.eye=90", "view.0.eye: 90 found, a list of 3 numbers expected"},
      {"view.0.width=true", "view.0.width: true found"},
      {"light.0.elevation=low", "light.0.elevation: the string \"low\" found"},
      {"method.0.parameters.steps=few", "method.0.parameters.steps: the string \"few\" found"},
      {"bake=8", "bake: 8 found, a table expected"},
      {"truth=[]", "truth: a list of 0 found, a table expected"},
      // out of range
      {"surface.quads=[0, 1]", "surface.quads: 0 found, a number of at least 1 and at most 4096"},
      {"surface.size=[64, -32]", "surface.size: -32 found, a number above 0 expected"},
      {"surface.size=[64, 1e13]", "surface.shape: plane: height is 1e+13, expected"},
      {"relief.texels=[64, 16385]", "relief.texels: 16385 found"},
      {"relief.period=0.5", "relief.pattern: relief.period: 0.5 found, 1 to"},
      {"relief.height=1e7", "relief.height: 10000000 found"},
      {"relief.repeats=[0, 1]", "relief.repeats: 0 found, a number above 0 expected"},
      {"bake.azimuths=0", "bake.azimuths: 0 found, a whole number from 1 to 1024 expected"},
      {"bake.radius=0", "bake.radius: 0 found, a number above 0"},
      {"bake.bits=9", "bake.bits: 9 found, 8, 16 or 32 expected"},
      {"base.subdivisions=0", "base.subdivisions: 0 found"},
      {"base.curvature=mesh",
       "base.curvature: the string \"mesh\" found, one of limit, vertices expected"},
      {"surface.scheme=loop", "surface.scheme: unknown key"},
      {"truth.step=0", "truth.step: 0 found, a number above 0 expected"},
      {"view.0.fov=180", "view.0.fov: 180 found, a number of at least 0.1 and at most 170"},
      {"view.0.width=0", "view.0.width: 0 found, a whole number from 1 to 16384"},
      {"view.1.samples=0", "view.1.samples: 0 found"},
      {"light.0.elevation=90.5", "light.0.elevation: 90.5 found"},
      // what is missing or one too many
      {"surface.mesh=a.obj", "surface.mesh: `shape` found beside it, one of the two expected"},
      {"relief.image=a.exr", "relief.image: `pattern` found beside it"},
      {"method.0.file=a.glsl", "method.0.file: `name` found beside it"},
      {"method=[{}]", "method.0.name: missing, either `name` or `file` expected"},
      {"surface={quads=[1, 1]}", "surface.shape: missing, either `shape` or `mesh` expected"},
      {"view=[{type=\"camera\"}]", "view.0.eye: missing, a list of 3 numbers expected"},
      {"light=[{azimuth=3}]", "light.0.elevation: missing, a number or a list of numbers"},
      // names that do not exist
      {"surface.shape=cube",
       "the string \"cube\" found, one of plane, cylinder, sphere, torus, bezier, b-spline"},
      {"relief.pattern=noise",
       "the string \"noise\" found, one of columns, cosine, cells, ripples expected"},
      {"relief.wrap=mirror", "one of repeat, clamp expected"},
      {"relief.height_space=tangent", "one of world, texture expected"},
      {"view.0.type=orthographic", "one of camera, atlas expected"},
      {"method.0.name=max-forsythe", "method.0.name: no method `max-forsythe`, there are "},
      {"method.0.filter=nearest", "one of exact, hardware expected"},
      // empty lists
      {"view=[]", "view: a list of 0 found, at least one [[view]] expected"},
      {"light=[]", "light: a list of 0 found, at least one [[light]] expected"},
      {"method=[]", "method: a list of 0 found, at least one [[method]] expected"},
      {"threshold=[]", "threshold: a list of 0 found, at least one [[threshold]] expected"},
      {"light.0.azimuth=[]", "light.0.azimuth: a list of 0 found"},
      // names twice
      {"view.1.name=camera", "view \"camera\" appears twice, distinct names expected"},
      {"method.1.label=max-forsyth", "method label \"max-forsyth\" appears twice"},
      {"light.0.elevation=[30, 30]", "light \"elevation 30° azimuth 20°\" appears twice"},
      {"method.1.label=truth", "method.1.label: \"truth\" found, that name is taken"},
      // names that become a folder
      {"study.name=../up", "study.name: \"../up\" found, letters, digits, - and _ expected"},
      {"study.name=.hidden", "study.name: \".hidden\" found"},
      {"study.name=a b", "study.name: \"a b\" found"},
      // shapes that the surface code refuses
      {R"(surface={shape="sphere", quads=[1, 1], size=[9, 9], curvature=0.1})",
       "surface.shape: sphere: rows is 1"},
      {R"(surface={shape="torus", quads=[60, 60], major=1, minor=1})",
       "surface.shape: torus: minor is 1, expected less than major"},
      {R"(surface={shape="torus", quads=[60, 60], major=1, minor=1.5})",
       "surface.minor: 1.5 found, a number above 0 and at most 1 expected"},
      {R"(surface={shape="bezier", quads=[1, 1], points=[[0, 0, 0]]})",
       "surface.points: 1 points found, 16 expected"},
      {R"(surface={shape="b-spline", columns=4, points=[[0, 0, 0]]})",
       "surface.points: 1 points found, at least 4 rows of 4 expected"},
  };
  for (const Refusal& refusal : refusals) {
    SCOPED_TRACE(refusal.change);
    const std::string message = failureWith({refusal.change});
    EXPECT_THAT(message, StartsWith("plain.toml"));
    EXPECT_THAT(message, HasSubstr(refusal.message));
  }
}

TEST_F(StudyFile, NamesTheLine) {
  EXPECT_THAT(failureOf("height = 4\n", "height = true\n"),
              StartsWith("plain.toml:14: relief.height: true found"));
  EXPECT_THAT(failureOf("height_space = \"world\"\n", ""),
              StartsWith("plain.toml:11: relief.height_space: missing"));
  EXPECT_THAT(failureOf("label =", "lable ="),
              StartsWith("plain.toml:36: method.1.lable: unknown"));
  EXPECT_THAT(failureOf("shape = \"plane\"", "shape = \"sphere\""),
              StartsWith("plain.toml:6: surface.curvature: missing"));
  EXPECT_THAT(failureOf("pattern = \"columns\"\n", ""),
              StartsWith("plain.toml:11: relief.pattern: missing, either"));
}

TEST_F(StudyFile, MissesEverySection) {
  for (const std::string section : {"study", "surface", "relief", "view", "light", "method"}) {
    // Renamed everywhere, so that nothing else changes.
    std::string text = plainStudy;
    const std::string opening = "[" + section + "]";
    for (std::size_t at = 0; (at = text.find(opening, at)) != std::string::npos; ++at) {
      text.replace(at, opening.size(), "[x" + section + "]");
    }
    EXPECT_THAT(failure(text), HasSubstr(section + ": missing"));
  }
}

TEST_F(StudyFile, NamesFilesThatAreMissing) {
  EXPECT_THAT(failureWith({R"(relief={image="none.exr", height=1, height_space="world"})"}),
              StartsWith("none.exr: no such file"));
  EXPECT_THAT(failureWith({R"(surface={mesh="none.obj"})"}), StartsWith("none.obj: no such file"));
  EXPECT_THAT(messageOf<InputError>([&] { (void)readStudy(file("none.toml")); }),
              HasSubstr("none.toml: no such file"));
}

// ---- the studies that come with the program

TEST(Scenes, CanAllBeRead) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(GNOMON_SCENES)) {
    if (entry.path().extension() != ".toml") continue;
    ++count;
    StudySpec study = readStudy(entry.path());
    EXPECT_EQ(study.name, entry.path().stem().string());
    EXPECT_FALSE(study.claims.empty() && study.thresholds.empty()) << entry.path();
  }
  EXPECT_GE(count, 3);
}

}  // namespace
}  // namespace gnomon
