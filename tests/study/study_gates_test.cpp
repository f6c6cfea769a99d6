#include "study/study_file_fixture.h"

namespace gnomon {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

using StudyGates = StudyFile;

TEST_F(StudyGates, AGateHasItsFilters) {
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

TEST_F(StudyGates, AFilterThatMatchesNothingIsAFault) {
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

TEST_F(StudyGates, AGateNeedsALimit) {
  EXPECT_THAT(failure(std::string(plainStudy) + "\n[[threshold]]\nmetric = \"iou\"\n"),
              HasSubstr("threshold.0.max: `max` or `min` expected"));
  EXPECT_THAT(failure(std::string(plainStudy) + "\n[[threshold]]\nmax = nan\n"),
              HasSubstr("nan found, a finite number expected"));
}

TEST_F(StudyGates, AClaimNamesTwoMethods) {
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

TEST_F(StudyGates, AClaimMayPutOneMethodBetweenBounds) {
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

}  // namespace
}  // namespace gnomon
