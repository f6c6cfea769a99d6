#include <gmock/gmock.h>

#include <algorithm>

#include "end_to_end/support/program.h"

// [truth] uncertainty: the micro-mesh is refined until the truth is as certain as is asked for.

namespace gnomon::test {
namespace {

using ::testing::HasSubstr;

class Refinement : public EndToEnd {
 protected:
  /// The small study with an uncertainty wanted.
  static std::string wanting(double uncertainty) {
    return replaced(smallStudy(), "step = 0.25", "uncertainty = " + std::to_string(uncertainty));
  }
};

TEST_F(Refinement, StopsAtTheFirstLevelThatIsCertainEnough) {
  runStudy("small", wanting(0.004));
  const auto truth = summary("small").at("truth");
  EXPECT_EQ(truth.at("wanted_uncertainty"), 0.004);
  const auto& levels = truth.at("refinement");
  ASSERT_GE(levels.size(), 3U) << "else the study is too easy to show anything";
  EXPECT_EQ(levels[0].at("step_texels"), 1);
  EXPECT_TRUE(levels[0].at("flip_rate").is_null());
  for (std::size_t k = 1; k < levels.size(); ++k) {
    EXPECT_EQ(2 * levels[k].at("step_texels").get<double>(), levels[k - 1].at("step_texels"));
    EXPECT_GT(levels[k].at("micro_triangles"), levels[k - 1].at("micro_triangles"));
    EXPECT_EQ(levels[k].at("flip_rate").get<double>() <= 0.004, k + 1 == levels.size());
  }
  // The run's own uncertainty is measured anew, and is the last level's rate to the bit.
  EXPECT_EQ(truth.at("uncertainty"), levels.back().at("flip_rate"));
  EXPECT_EQ(truth.at("step_texels"), levels.back().at("step_texels"));
  EXPECT_EQ(truth.at("micro_triangles"), levels.back().at("micro_triangles"));
  EXPECT_THAT(read("out/small/report.html"), HasSubstr("Refined until at most 0.4 %"));
}

TEST_F(Refinement, IsTheRunAtTheStepThatItFinds) {
  runStudy("small", wanting(0.004));
  const auto refined = summary("small");
  const std::string step = refined.at("truth").at("step_texels").dump();
  runStudy("small", replaced(smallStudy(), "step = 0.25", "step = " + step), {"--out", "fixed"});
  const auto fixed = summary("small", "fixed");
  EXPECT_EQ(refined.at("results"), fixed.at("results"));
  EXPECT_EQ(refined.at("truth").at("flips"), fixed.at("truth").at("flips"));
}

// The level that is certain enough is found by the mean change of the shares.
TEST_F(Refinement, GoesByTheSharesOfASoftLight) {
  const auto soft = [](const std::string& text) {
    return replaced(text, "elevation = 30\n", "elevation = 30\nradius = 4\n");
  };
  constexpr double wanted = 0.002;
  runStudy("small", soft(wanting(wanted)));
  const auto truth = summary("small").at("truth");
  const auto& levels = truth.at("refinement");
  ASSERT_GE(levels.size(), 3U);
  EXPECT_EQ(truth.at("uncertainty"), levels.back().at("flip_rate"));
  EXPECT_EQ(truth.at("uncertainty"), truth.at("flips").at(0).at("shares").at("mae"));
  EXPECT_LE(truth.at("uncertainty"), wanted);
  EXPECT_GT(levels[levels.size() - 2].at("flip_rate"), wanted);
  runStudy("small", wanting(wanted), {"--out", "hard"});
  EXPECT_NE(summary("small", "hard").at("truth").at("refinement").at(1).at("flip_rate"),
            levels[1].at("flip_rate"));
}

TEST_F(Refinement, SaysWhatIsReachedWhereTheWishIsNot) {
  // One long face: its third level has more lines than a grid can have.
  const std::string text = replaced(replaced(wanting(0.004), "quads = [4, 4]", "quads = [1, 1]"),
                                    "texels = [32, 32]", "texels = [9000, 4]");
  write("small.toml", replaced(text, "uncertainty = 0.004", "uncertainty = 1e-9 # "));
  const Outcome outcome = gnomon({"truth", "small.toml"});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, HasSubstr("truth.uncertainty = 1e-09 is not reached: 0."));
  EXPECT_THAT(outcome.err, HasSubstr("at a step of 0.5 texels (288000 micro-triangles). The next "
                                     "level: truth.step: 0.25 texels make 36000 lines across one"));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_EQ(filesBelow("out"), std::vector<std::string>{"small/truth/files.txt"});
}

TEST_F(Refinement, IsRefusedBesideAStep) {
  write("small.toml", smallStudy());
  const Outcome outcome = gnomon({"truth", "small.toml", "--set", "truth.uncertainty=0.001"});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, HasSubstr("truth.uncertainty: `step` found beside it"));
}

}  // namespace
}  // namespace gnomon::test
