#include <gmock/gmock.h>

#include <cmath>
#include <fstream>

#include "study/spec/resolved_study.h"
#include "study/spec/study_file_fixture.h"
#include "study/spec/sweep/sweep.h"
#include "truth/disc_directions.h"

// `[[light]] radius` and `sun`, `[truth] directions` and `[[method]] disc`.

namespace gnomon::study {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

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
