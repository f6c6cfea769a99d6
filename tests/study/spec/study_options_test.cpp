#include <fstream>

#include "common/error.h"
#include "study/spec/study_file.h"
#include "support/columns_study.h"
#include "support/error_messages.h"
#include "support/temporary_folder.h"

// What the command line changes in a study: which methods and gates are left, and what stands in a
// method's place.

namespace gnomon::study {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string gatedStudy = test::planeStudy("gated") + R"(
[[view]]
type = "atlas"
samples = 11

[[light]]
elevation = 30

[[method]]
name = "max-forsyth"

[[method]]
name = "onoue-2004"
label = "ours"
bake = { azimuths = 12 }

[[method]]
name = "resampled-horizon"
parameters = { crossings = 7 }

[[ladder]]
method = "resampled-horizon"
[[ladder.rung]]
cause = "bits"
set = { bake = { bits = 32 } }

[[threshold]]
method = "ours"
max = 0.1

[[threshold]]
method = "max-forsyth"
max = 0.2
quick = false
)";

class StudyOptionsTest : public TemporaryFolder {
 protected:
  StudySpec read(const StudyOptions& options, const std::string& more = {}) {
    std::ofstream(file("gated.toml"), std::ios::binary) << gatedStudy << more;
    return readStudy(file("gated.toml"), options);
  }
  StudySpec replacing(const std::string& text) {
    StudyOptions options;
    options.replacements = {text};
    return read(options);
  }
  static std::vector<std::string> labels(const StudySpec& study) {
    std::vector<std::string> names;
    for (const MethodSpec& method : study.methods) names.push_back(method.label);
    return names;
  }
};

TEST_F(StudyOptionsTest, GatesKnowTheirLines) {
  const StudySpec study = read({});
  ASSERT_EQ(study.thresholds.size(), 2U);
  EXPECT_EQ(std::get<Threshold>(study.thresholds.at(0).origin).line, 42);
  EXPECT_EQ(std::get<Threshold>(study.thresholds.at(1).origin).line, 46);
  EXPECT_TRUE(study.leftOut.empty());
}

TEST_F(StudyOptionsTest, QuickLeavesOutGatesOfTheFullForm) {
  StudyOptions options;
  options.quick = true;
  const StudySpec study = read(options);
  ASSERT_EQ(study.thresholds.size(), 1U);
  EXPECT_EQ(study.thresholds.at(0).method, "ours");
  ASSERT_EQ(study.leftOut.size(), 1U);
  EXPECT_EQ(study.leftOut.at(0).gate.method, "max-forsyth");
  EXPECT_EQ(study.leftOut.at(0).verdict, GateVerdict::skipped);
  EXPECT_THAT(study.leftOut.at(0).reason, HasSubstr("full form only"));
}

TEST_F(StudyOptionsTest, QuickKeepsAnAtlasOdd) {
  StudyOptions options;
  for (const int samples : {1, 2, 7, 8, 9, 11, 21, 100}) {
    options.overrides = {"view.0.samples=" + std::to_string(samples)};
    options.quick = true;
    const int quick = std::get<AtlasSpec>(read(options).views.at(0).kind).samplesPerSide;
    EXPECT_EQ(quick % 2, 1) << samples;
    EXPECT_LE(quick, std::max(1, samples / 4 + 1));
    EXPECT_GE(quick, samples / 4);
    options.quick = false;
    EXPECT_EQ(std::get<AtlasSpec>(read(options).views.at(0).kind).samplesPerSide, samples);
  }
}

TEST_F(StudyOptionsTest, MethodsThatAreLeftOutTakeTheirGatesAlong) {
  StudyOptions options;
  options.methods = {"ours"};
  const StudySpec study = read(options);
  EXPECT_THAT(labels(study), ElementsAre("ours"));
  EXPECT_THAT(study.leftOutMethods, ElementsAre("max-forsyth", "resampled-horizon"));
  ASSERT_EQ(study.leftOut.size(), 1U);
  EXPECT_EQ(study.leftOut.at(0).gate.method, "max-forsyth");
  EXPECT_EQ(study.leftOut.at(0).reason, "its method is left out");
}

TEST_F(StudyOptionsTest, GatedOnlyKeepsWhatGatesSpeakOf) {
  StudyOptions options;
  options.gatedOnly = true;
  EXPECT_THAT(labels(read(options)), ElementsAre("max-forsyth", "ours"));
  EXPECT_TRUE(read(options).ladders.empty());
  EXPECT_EQ(labels(read(options, "\n[[threshold]]\nmax = 0.9\n")).size(), 3U)
      << "a gate on all methods needs all";
  options.quick = true;
  EXPECT_THAT(labels(read(options)), ElementsAre("ours"));
}

TEST_F(StudyOptionsTest, AReplacedMethodKeepsItsLabelAndOverrides) {
  const StudySpec study = replacing("ours=max-forsyth");
  EXPECT_THAT(labels(study), ElementsAre("max-forsyth", "ours", "resampled-horizon"));
  EXPECT_EQ(study.methods.at(1).file.filename(), "max-forsyth.glsl");
  EXPECT_EQ(study.methods.at(1).bake.settings.azimuths, 12);
  EXPECT_EQ(study.thresholds.size(), 2U);
  EXPECT_EQ(study.methods.at(0).file.filename(), "max-forsyth.glsl");
}

TEST_F(StudyOptionsTest, AReplacedMethodLosesItsParametersAndLadder) {
  EXPECT_EQ(read({}).methods.at(2).parameters.size(), 1U);
  EXPECT_EQ(read({}).ladders.size(), 1U);
  const StudySpec study = replacing("resampled-horizon=unshadowed");
  EXPECT_TRUE(study.methods.at(2).parameters.empty());
  EXPECT_TRUE(study.ladders.empty());
}

TEST_F(StudyOptionsTest, AFileReplacesRelativeToTheCurrentFolder) {
  std::ofstream(file("mine.glsl")) << "/* gnomon-method\ntitle = \"t\"\ncitation = \"c\"\n*/\n"
                                      "bool isShadowed(Pixel p, LocalLight l) { return true; }\n";
  const std::filesystem::path relative =
      std::filesystem::relative(file("mine.glsl"), std::filesystem::current_path());
  const StudySpec study = replacing("ours=" + relative.string());
  EXPECT_EQ(std::filesystem::canonical(study.methods.at(1).file),
            std::filesystem::canonical(file("mine.glsl")));
  EXPECT_EQ(study.methods.at(1).label, "ours");
}

TEST_F(StudyOptionsTest, ReplacementsThatMakeNoSenseAreRefused) {
  for (const char* text : {"ours", "=max-forsyth", "ours="}) {
    EXPECT_THAT(messageOf<UsageError>([&] { (void)replacing(text); }),
                HasSubstr("METHOD=NAME or METHOD=FILE.glsl expected"));
  }
  EXPECT_THAT(messageOf<UsageError>([&] { (void)replacing("onoue-2004=max-forsyth"); }),
              HasSubstr("gated.toml has max-forsyth, ours, resampled-horizon"));
  EXPECT_THAT(messageOf<InputError>([&] { (void)replacing("ours=no-such-method"); }),
              HasSubstr("method.1.name"));
  StudyOptions options;
  options.replacements = {"ours=max-forsyth", "ours=unshadowed"};
  EXPECT_THAT(messageOf<UsageError>([&] { (void)read(options); }), HasSubstr("replaced twice"));
}

}  // namespace
}  // namespace gnomon::study
