#include <gmock/gmock.h>

#include "end_to_end/support/program.h"

namespace gnomon::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* sweptHeights = R"(
[sweep]
key = "relief.height"
values = [1, 6]
axis = "height, world units"
)";

constexpr const char* claim = R"(
[[claim]]
text = "Shadows matter"
source = "a test"
less = "max-forsyth"
than = "unshadowed"
)";

std::string sweepStudy() {
  return smallStudy() + claim + sweptHeights;
}

class SweepRun : public EndToEnd {};

TEST_F(SweepRun, EveryStepIsTheRunThatAnOverrideGives) {
  runStudy("small", sweepStudy());
  for (const char* height : {"1", "6"}) {
    runStudy("small", smallStudy(),
             {"--set", std::string("relief.height=") + height, "--out",
              std::string("single-") + height});
    const nlohmann::json step = summary(std::string("small/") + height);
    const nlohmann::json single = summary("small", std::string("single-") + height);
    EXPECT_EQ(step.at("results"), single.at("results"));
    const std::string mask = "/masks/camera_evening_max-forsyth.png";
    EXPECT_EQ(read(std::string("out/small/") + height + mask),
              read(std::string("single-") + height + "/small" + mask));
  }
}

TEST_F(SweepRun, LeavesItsPlotTableAndSummary) {
  runStudy("small", sweepStudy());
  const nlohmann::json json = summary("small");
  EXPECT_EQ(json.at("schema"), "gnomon-sweep/3");
  EXPECT_EQ(json.at("keys").at(0).at("axis"), "height, world units");
  ASSERT_EQ(json.at("results").size(), 4U);
  for (const nlohmann::json& row : json.at("results")) {
    const nlohmann::json step = summary(row.at("case") == 1 ? "small/1" : "small/6");
    // One light and one view: the mean is the result.
    const nlohmann::json result = resultOf(step, row.at("method"), "evening", "camera");
    for (const char* figure : {"error_rate", "false_shadow", "false_light"}) {
      EXPECT_EQ(row.at(figure), result.at(figure));
    }
    EXPECT_EQ(row.at("uncertainty"), step.at("truth").at("flips").at(0).at("flip_rate"));
  }
  EXPECT_EQ(summary("small/6").at("claims").at(0).at("verdict"), "held");
  EXPECT_EQ(json.at("claims").at(0).at("verdict"), "not distinguishable") << "as of a low relief";
  EXPECT_THAT(read("out/small/sweep.csv"), HasSubstr("\n6,max-forsyth,"));
  EXPECT_THAT(read("out/small/plots/sweep.svg"), HasSubstr("height, world units"));
  EXPECT_THAT(read("out/small/report.html"), HasSubstr("<figure class=\"plot"));
}

TEST_F(SweepRun, TwiceGivesTheSameBytes) {
  runStudy("small", sweepStudy());
  runStudy("small", sweepStudy(), {"--out", "again"});
  for (const char* name :
       {"/small/sweep.csv", "/small/plots/sweep.svg", "/small/plots/sweep.pdf"}) {
    EXPECT_EQ(read(std::string("out") + name), read(std::string("again") + name));
    EXPECT_FALSE(read(std::string("out") + name).empty());
  }
}

TEST_F(SweepRun, OneGateThatFailsAtOneValueFailsTheCheck) {
  const auto errorAt = [&](const char* height) {
    return resultOf(summary(std::string("small/") + height), "unshadowed", "evening", "camera")
        .at("error_rate")
        .get<double>();
  };
  runStudy("small", sweepStudy());
  ASSERT_GT(errorAt("6"), 1.2 * errorAt("1"));
  const auto checkWith = [&](double limit) {
    write("small.toml", sweepStudy() + "\n[[threshold]]\nmethod = \"unshadowed\"\nmax = " +
                            nlohmann::json(limit).dump() + "\n");
    return gnomon({"check", "small.toml"});
  };
  EXPECT_EQ(checkWith(1.01 * errorAt("6")).status, 0);
  const Outcome failed = checkWith(1.01 * errorAt("1"));
  EXPECT_EQ(failed.status, 1) << failed.err;
  EXPECT_THAT(failed.out, HasSubstr(", camera, evening, at 6: 0."));
  EXPECT_EQ(summary("small").at("status"), "fail");
  EXPECT_EQ(summary("small/1").at("status"), "pass");
  EXPECT_EQ(summary("small/6").at("status"), "fail");
}

TEST_F(SweepRun, IsOneStudyOfTheRanking) {
  write("small.toml", sweepStudy());
  write("other.toml", replaced(smallStudy(), "\"small\"", "\"other\""));
  const Outcome outcome = gnomon({"run", "other.toml", "small.toml"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const nlohmann::json json = nlohmann::json::parse(read("out/ranking.json"));
  ASSERT_EQ(json.at("studies").size(), 2U);
  EXPECT_EQ(json.at("studies").at(1).at("name"), "small");
  ASSERT_EQ(json.at("results").size(), 4U);
  double sum = 0;
  const nlohmann::json sweep = summary("small");
  for (const nlohmann::json& row : sweep.at("results")) {
    if (row.at("method") == "unshadowed") sum += row.at("error_rate").get<double>();
  }
  EXPECT_EQ(json.at("results").at(2).at("method"), "unshadowed");
  EXPECT_DOUBLE_EQ(json.at("results").at(2).at("error_rate"), sum / 2);
}

TEST_F(SweepRun, TakesTheOptionsOfARun) {
  runStudy("small", sweepStudy(),
           {"--quick", "--method", "max-forsyth", "--set", "sweep.values=[1, 3, 5]", "--set",
            "truth.step=0.125"});
  const nlohmann::json json = summary("small");
  ASSERT_EQ(json.at("steps").size(), 3U);
  EXPECT_THAT(json.at("steps").at(2).at("values"), ElementsAre(5));
  EXPECT_EQ(json.at("results").size(), 3U);
  EXPECT_EQ(summary("small/5").at("panels").at(0).at("width"), 16);
}

TEST_F(SweepRun, BakesTheTablesOfEveryValue) {
  write("small.toml", smallStudy() + "\n[sweep]\nkey = \"bake.radius\"\nvalues = [4, 8]\n");
  const Outcome outcome = gnomon({"bake", "small.toml"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(read("out/small/4/tables.exr"), read("out/small/8/tables.exr"));
}

TEST_F(SweepRun, ErrorsNameFileLineAndKey) {
  write("small.toml", smallStudy() + "[sweep]\nkey = \"relief.hight\"\nvalues = [1, 2]\n");
  const Outcome unknown = gnomon({"run", "small.toml"});
  EXPECT_EQ(unknown.status, 3);
  EXPECT_THAT(unknown.err, HasSubstr(": sweep.key: with relief.hight=1: "));
  write("small.toml", smallStudy() + "[sweep]\nkey = \"truth.step\"\nvalues = [0.25, 100]\n");
  const Outcome coarse = gnomon({"run", "small.toml"});
  EXPECT_EQ(coarse.status, 3);
  EXPECT_THAT(coarse.err, HasSubstr("small.toml: small/100: truth.step"));
  // The first value's report is whole, the sweep has none.
  EXPECT_EQ(summary("small/0.25").at("schema"), "gnomon-summary/2");
  EXPECT_FALSE(std::filesystem::exists(file("out/small/summary.json")));
}

TEST_F(SweepRun, WithoutGnuplotNothingIsRun) {
  write("small.toml", sweepStudy());
  const Outcome outcome = gnomon({"run", "small.toml"}, {"PATH=/nowhere"});
  EXPECT_EQ(outcome.status, 4);
  EXPECT_THAT(outcome.err, HasSubstr("gnomon: gnuplot: cannot be started"));
  EXPECT_TRUE(filesBelow("out").empty());
}

}  // namespace
}  // namespace gnomon::test
