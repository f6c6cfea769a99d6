#include "study/spec/study_file_fixture.h"

namespace gnomon::study {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

using StudyGates = StudyFile;

TEST_F(StudyGates, AGateHasItsFilters) {
  const StudySpec study = read(plainStudy + R"(
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
  EXPECT_EQ(study.thresholds[1].metric, compare::metrics::errorRate);
  EXPECT_FALSE(study.thresholds[1].minimum);
}

TEST_F(StudyGates, AFilterThatMatchesNothingIsAFault) {
  const auto refused = [&](const std::string& line) {
    return failure(plainStudy + "\n[[threshold]]\nmax = 0.1\n" + line);
  };
  EXPECT_EQ(refused("method = \"onoue-2004\"\n"),
            "plain.toml:40: threshold.0.method: \"onoue-2004\" found, one of max-forsyth, ours "
            "expected");
  EXPECT_THAT(refused("light = \"noon\"\n"),
              HasSubstr("threshold.0.light: \"noon\" found, one of elevation 30° azimuth 20°"));
  EXPECT_THAT(refused("view = \"front\"\n"), HasSubstr("one of camera, atlas expected"));
  EXPECT_THAT(
      refused("region = \"dark\"\n"),
      HasSubstr(
          "one of all, lit, attached, cast, distant, global, beyond-terminator, seam expected"));
  EXPECT_THAT(refused("metric = \"accuracy\"\n"),
              AllOf(HasSubstr("\"accuracy\" found, one of error_rate"), HasSubstr("mcc")));
  EXPECT_THAT(refused("method = \"\"\n"), HasSubstr("a string that is not empty expected"));
  EXPECT_THAT(refused("maximum = 3\n"), HasSubstr("threshold.0.maximum: unknown key"));
}

TEST_F(StudyGates, AGateNeedsALimit) {
  EXPECT_THAT(failure(plainStudy + "\n[[threshold]]\nmetric = \"iou\"\n"),
              HasSubstr("threshold.0.max: `max` or `min` expected"));
  EXPECT_THAT(failure(plainStudy + "\n[[threshold]]\nmax = nan\n"),
              HasSubstr("nan found, a finite number expected"));
}

TEST_F(StudyGates, ALimitOfAShareMayBeAPercentage) {
  const StudySpec study = read(plainStudy + R"(
[[threshold]]
min = "0.7 %"
max = "5 %"
)");
  EXPECT_EQ(study.thresholds.at(0).minimum, 0.007);
  EXPECT_EQ(study.thresholds.at(0).maximum, 0.05);
}

TEST_F(StudyGates, ALimitThatNothingCanFailIsAFault) {
  const auto refused = [&](const std::string& lines) {
    return failure(plainStudy + "\n[[threshold]]\n" + lines);
  };
  EXPECT_EQ(
      refused("max = 20\n"),
      "plain.toml:39: threshold.0.max: 20 found, 0 to 1 expected; error_rate is a share: 0.05, "
      "or \"5 %\"");
  EXPECT_THAT(refused("max = 1\n"), HasSubstr("threshold.0.max: 1 found, which no error_rate can "
                                              "miss: below 1 expected"));
  EXPECT_THAT(refused("min = 0\n"), HasSubstr("threshold.0.min: 0 found, which no error_rate can "
                                              "miss: above 0 expected"));
  EXPECT_THAT(refused("min = 0.5\nmax = 0.4\n"),
              HasSubstr("`min` = 0.5 found, at most `max` = 0.4"));
  EXPECT_THAT(refused("max = \"0.05\"\n"),
              HasSubstr("a number, or a percentage as \"5 %\" expected"));
  EXPECT_THAT(refused("metric = \"mcc\"\nmin = \"5 %\"\n"), HasSubstr("a number expected"));
  EXPECT_THAT(refused("metric = \"hd95\"\nmax = 1e6\n"), HasSubstr("1000000 found, 0 to "));
  EXPECT_THAT(refused("region = \"lit\"\nmetric = \"false_light\"\nmax = 0.1\n"),
              HasSubstr("threshold.0.region: \"lit\" found, but there the region alone decides "
                        "false_light"));
}

TEST_F(StudyGates, AClaimNamesTwoMethods) {
  const std::string claim =
      plainStudy + "\n[[claim]]\ntext = \"t\"\nsource = \"s\"\nless = \"ours\"\n";
  const StudySpec study = read(claim + "than = \"max-forsyth\"\n");
  ASSERT_EQ(study.claims.size(), 1U);
  EXPECT_EQ(study.claims[0].metric, compare::metrics::errorRate);
  EXPECT_THAT(failure(claim), HasSubstr("claim.0.than: missing"));
  EXPECT_THAT(failure(claim + "than = \"theirs\"\n"),
              HasSubstr("\"theirs\" found, one of max-forsyth, ours expected"));
}

TEST_F(StudyGates, AClaimMayPutOneMethodBetweenBounds) {
  const std::string claim = plainStudy + "\n[[claim]]\ntext = \"t\"\nsource = \"s\"\n";
  const StudySpec study = read(claim + R"(method = "ours"
metric = "shadow_length_ratio"
region = "beyond-terminator"
above = 0.95
below = 1.05
)");
  ASSERT_EQ(study.claims.size(), 1U);
  EXPECT_EQ(study.claims[0].method, "ours");
  EXPECT_EQ(study.claims[0].metric, compare::metrics::shadowLengthRatio);
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
}  // namespace gnomon::study
