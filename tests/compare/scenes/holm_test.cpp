#include "compare/scenes/holm.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace gnomon::compare {
namespace {

std::vector<double> adjusted(const std::vector<double>& probabilities) {
  std::vector<double> found;
  for (const HolmStep& step : holmSteps(probabilities)) found.push_back(step.adjusted);
  return found;
}

void expectNear(const std::vector<double>& found, const std::vector<double>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-12) << i;
}

/// The example of most texts: of four hypotheses the fourth and the first are rejected.
TEST(Holm, OfATextbookExample) {
  const std::vector<double> probabilities = {0.01, 0.04, 0.03, 0.005};
  expectNear(adjusted(probabilities), {0.03, 0.06, 0.06, 0.02});
  const std::vector<HolmStep> steps = holmSteps(probabilities);
  expectNear({steps[0].allowed, steps[1].allowed, steps[2].allowed, steps[3].allowed},
             {0.05 / 3, 0.05 / 2, 0.05 / 2, 0.05 / 4});
  EXPECT_TRUE(isRejected(probabilities[3], steps[3].allowed));
  EXPECT_TRUE(isRejected(probabilities[0], steps[0].allowed));
  EXPECT_FALSE(isRejected(probabilities[2], steps[2].allowed));
  EXPECT_FALSE(isRejected(probabilities[1], steps[1].allowed));
}

/// p.adjust(…, "holm") of R.
TEST(Holm, NeverFallsFromStepToStep) {
  expectNear(adjusted({0.01, 0.02, 0.03, 0.04, 0.05}), {0.05, 0.08, 0.09, 0.09, 0.09});
  expectNear(adjusted({0.5, 0.9, 0.9}), {1, 1, 1});
  expectNear(adjusted({0.05}), {0.05});
  EXPECT_TRUE(holmSteps({}).empty());
}

/// Once a step is no rejection, none after it is one, although its own p would do alone.
TEST(Holm, StopsAtTheFirstThatIsNoRejection) {
  const std::vector<double> probabilities = {0.03, 0.04};
  for (const HolmStep& step : holmSteps(probabilities)) {
    EXPECT_FALSE(isRejected(0.03, step.allowed));
    EXPECT_GT(step.adjusted, 0.05);
  }
}

/// Both ways to ask say the same, also where p is the allowed error itself but for rounding.
TEST(Holm, AdjustedAndAllowedAgree) {
  std::vector<double> probabilities;
  for (int c = 1; c <= 190; ++c) probabilities.push_back(c * c / 20000.0 / 3);
  probabilities.push_back(50 / 20000.0 / 20);
  std::reverse(probabilities.begin(), probabilities.end());
  const std::vector<HolmStep> steps = holmSteps(probabilities);
  std::size_t rejected = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const bool is = isRejected(probabilities[i], steps[i].allowed);
    EXPECT_EQ(is, isRejected(steps[i].adjusted, 0.05)) << i;
    rejected += is ? 1 : 0;
  }
  EXPECT_GT(rejected, 1U);
  EXPECT_LT(rejected, 100U);
}

}  // namespace
}  // namespace gnomon::compare
