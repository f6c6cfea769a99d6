#include <gmock/gmock.h>

#include "end_to_end/support/program.h"

namespace gnomon::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class RankingOverStudies : public EndToEnd {
 protected:
  /// The small study under the name, with relief of some height.
  void writeStudy(const std::string& name, const std::string& height) const {
    write(name + ".toml", replaced(replaced(smallStudy(), "\"small\"", "\"" + name + "\""),
                                   "height = 4\n", "height = " + height + "\n"));
  }
  [[nodiscard]] double errorIn(const std::string& study, const std::string& method) const {
    return resultOf(summary(study), method, "evening", "camera").at("error_rate");
  }
  [[nodiscard]] nlohmann::json ranking() const {
    return nlohmann::json::parse(read("out/ranking.json"));
  }
};

TEST_F(RankingOverStudies, HoldsTheMeansOfTheStudies) {
  writeStudy("low", "2");
  writeStudy("high", "6");
  const Outcome outcome = gnomon({"run", "low.toml", "high.toml"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const nlohmann::json methods = ranking().at("methods");
  ASSERT_EQ(methods.size(), 2U);
  for (const nlohmann::json& method : methods) {
    const std::string label = method.at("label");
    const double low = errorIn("low", label);
    const double high = errorIn("high", label);
    EXPECT_DOUBLE_EQ(method.at("mean_error_rate"), (low + high) / 2);
    EXPECT_DOUBLE_EQ(method.at("worst_error_rate"), std::max(low, high));
    EXPECT_EQ(method.at("worst_study"), high > low ? "high" : "low");
    EXPECT_EQ(method.at("studies"), 2);
  }
  EXPECT_EQ(methods.at(0).at("label"), "max-forsyth");
  EXPECT_THAT(outcome.out, HasSubstr("Methods over 2 studies"));
  EXPECT_THAT(read("out/ranking.html"), HasSubstr("href=\"low/report.html\""));
  EXPECT_THAT(read("out/ranking.csv"), HasSubstr("\nhigh,max-forsyth,"));
}

TEST_F(RankingOverStudies, LeavesOutAStudyThatAsksForIt) {
  writeStudy("low", "2");
  writeStudy("high", "6");
  writeStudy("apart", "3");
  write("apart.toml", replaced(read("apart.toml"), "[study]\n", "[study]\nranked = false\n"));
  ASSERT_EQ(gnomon({"run", "low.toml", "apart.toml", "high.toml"}).status, 0);
  EXPECT_THAT(read("out/ranking.csv"), Not(HasSubstr("apart")));
  EXPECT_THAT(read("out/ranking.csv"), HasSubstr("\nhigh,"));
  ASSERT_EQ(gnomon({"run", "low.toml", "apart.toml", "--out", "two"}).status, 0);
  EXPECT_TRUE(std::filesystem::exists(file("two/apart/summary.json")));
  EXPECT_FALSE(std::filesystem::exists(file("two/ranking.csv")));
}

TEST_F(RankingOverStudies, OneStudyHasNone) {
  writeStudy("low", "2");
  const Outcome outcome = gnomon({"run", "low.toml"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, Not(HasSubstr("Methods over")));
  EXPECT_FALSE(std::filesystem::exists(file("out/ranking.json")));
}

TEST_F(RankingOverStudies, AFailedRunLeavesNoOlderOne) {
  writeStudy("low", "2");
  writeStudy("high", "6");
  ASSERT_EQ(gnomon({"run", "low.toml", "high.toml"}).status, 0);
  // Fails while it runs: the micro-mesh cannot be halved.
  ASSERT_EQ(gnomon({"run", "low.toml", "high.toml", "--set", "truth.step=100"}).status, 3);
  for (const char* name :
       {"out/ranking.json", "out/ranking.csv", "out/ranking.md", "out/ranking.html"}) {
    EXPECT_FALSE(std::filesystem::exists(file(name))) << name;
  }
}

}  // namespace
}  // namespace gnomon::test
