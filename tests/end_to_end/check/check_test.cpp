#include <gmock/gmock.h>

#include "end_to_end/support/program.h"

namespace gnomon::test {
namespace {

using ::testing::HasSubstr;

class Check : public EndToEnd {
 protected:
  [[nodiscard]] Outcome check(const std::string& threshold, const std::string& command = "check") {
    write("small.toml", smallStudy() + "\n[[threshold]]\n" + threshold);
    return gnomon({command, "small.toml"});
  }
  [[nodiscard]] double measured() {
    runStudy("small", smallStudy());
    return resultOf(summary("small"), "max-forsyth", "evening", "camera").at("error_rate");
  }
  static std::string limit(const std::string& key, double value) {
    return "method = \"max-forsyth\"\n" + key + " = " + nlohmann::json(value).dump() + "\n";
  }
};

TEST_F(Check, PassesAtAndAboveTheValueAndFailsBelow) {
  const double error = measured();
  ASSERT_GT(error, 0.02) << "or the limits below say nothing";
  EXPECT_EQ(check(limit("max", 1.01 * error)).status, 0);
  EXPECT_EQ(check(limit("max", error)).status, 0);
  EXPECT_EQ(check(limit("max", 0.99 * error)).status, 1);
  EXPECT_EQ(check(limit("min", 0.99 * error)).status, 0);
  EXPECT_EQ(check(limit("min", 1.01 * error)).status, 1);
}

TEST_F(Check, WritesItsReportWhetherItPassesOrNot) {
  EXPECT_EQ(check("max = 0.0001\n").status, 1);
  EXPECT_EQ(summary("small").at("status"), "fail");
  const nlohmann::json thresholds = summary("small").at("thresholds");
  ASSERT_EQ(thresholds.size(), 2U) << "one for each method";
  EXPECT_EQ(thresholds.at(0).at("passed"), false);
  EXPECT_EQ(thresholds.at(1).at("maximum"), 0.0001);
  EXPECT_EQ(thresholds.at(1).at("value"),
            resultOf(summary("small"), "max-forsyth", "evening", "camera").at("error_rate"));
}

TEST_F(Check, FailsOnAnUndefinedMetric) {
  // No occluder is farther than the radius, the whole map: nothing is distant.
  const Outcome outcome = check("region = \"distant\"\nmax = 0.5\n");
  EXPECT_EQ(outcome.status, 1) << outcome.err;
  EXPECT_TRUE(summary("small").at("thresholds").at(0).at("value").is_null());
  EXPECT_EQ(summary("small").at("thresholds").at(0).at("passed"), false);
}

TEST_F(Check, RefusesAStudyWithoutThresholds) {
  write("small.toml", smallStudy());
  const Outcome outcome = gnomon({"check", "small.toml"});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, HasSubstr("gnomon: small.toml: no [[threshold]]"));
  EXPECT_TRUE(filesBelow("out").empty());
}

TEST_F(Check, RunIgnoresThresholdsButRecordsThem) {
  EXPECT_EQ(check("max = 0.0001\n", "run").status, 0);
  EXPECT_EQ(summary("small").at("status"), "fail");
}

TEST_F(Check, OneStudyThatFailsFailsThemAll) {
  write("a.toml", replaced(smallStudy(), "\"small\"", "\"a\"") + "\n[[threshold]]\nmax = 0.9\n");
  write("b.toml", replaced(smallStudy(), "\"small\"", "\"b\"") + "\n[[threshold]]\nmax = 0.001\n");
  EXPECT_EQ(gnomon({"check", "a.toml"}).status, 0);
  EXPECT_EQ(gnomon({"check", "a.toml", "b.toml"}).status, 1);
  EXPECT_EQ(gnomon({"check", "b.toml", "a.toml"}).status, 1);
  EXPECT_EQ(summary("a").at("status"), "pass");
}

TEST_F(Check, TheControlFailsTheGateThatTheMethodPasses) {
  const double error = measured();
  const std::string gate = "max = " + nlohmann::json(1.2 * error).dump() + "\n";
  EXPECT_EQ(check("method = \"max-forsyth\"\n" + gate).status, 0);
  EXPECT_EQ(check("method = \"unshadowed\"\n" + gate).status, 1);
}

}  // namespace
}  // namespace gnomon::test
