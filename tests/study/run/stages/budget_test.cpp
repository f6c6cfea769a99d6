#include "study/run/stages/budget.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "common/error.h"
#include "study/judge/distinguish.h"

namespace gnomon::study {
namespace {

constexpr int samplesPerSide = 40;
constexpr std::size_t budgetSamples = 1600;
const compare::Tiling tiling{1, 40};  // 400 blocks of 2 × 2

Mask maskOf(const std::vector<Shade>& shades) {
  return {samplesPerSide, samplesPerSide, shades};
}

/// Lit everywhere but in its last quarter, which only distant occluders shadow.
truth::Truth madeUpTruth() {
  truth::Truth truth{maskOf(std::vector<Shade>(budgetSamples, Shade::lit)),
                     std::vector<truth::Region>(budgetSamples, truth::Region::lit), 0};
  for (std::size_t i = 1200; i < budgetSamples; ++i) {
    truth.mask.samples[i] = Shade::shadowed;
    truth.regions[i] = truth::Region::distant;
  }
  return truth;
}

/// The truth, wrong at one of every `step` samples from `first` to before `last`, without a
/// pattern.
Mask wrongAt(const truth::Truth& truth, std::size_t first, std::size_t last, std::size_t step) {
  Mask mask = truth.mask;
  for (std::size_t i = first; i < last; i += step) {
    Shade& shade = mask.samples[i + i / step * 7919 % 101 % step];
    shade = shade == Shade::lit ? Shade::shadowed : Shade::lit;
  }
  return mask;
}

LadderSpec ladderOf(std::vector<std::string> causes) {
  LadderSpec ladder;
  ladder.method = "old";
  for (const std::string& cause : causes) ladder.causes.push_back({cause, "nothing"});
  return ladder;
}

StateErrors errorsOf(const truth::Truth& truth, const Mask& mask) {
  return stateErrors(mask, truth, {}, tiling);
}

const BudgetShare& restNamed(const BudgetRecord& budget, std::string_view name) {
  return std::find_if(budget.rest.begin(), budget.rest.end(),
                      [&](const BudgetRest& rest) { return rest.name == name; })
      ->share;
}

double sumOf(const BudgetRecord& budget, BudgetShare BudgetCause::*way) {
  double sum = 0;
  for (const BudgetRest& rest : budget.rest) sum += rest.share.value;
  for (const BudgetCause& cause : budget.causes) sum += (cause.*way).value;
  return sum;
}

/// 160 wrong samples: undoing "even" first rights 80, "bad" makes 40 wrong, together they leave
/// 100, 20 of them distant.
TEST(Budget, IsWhatEachStepOfAMadeUpLadderChanges) {
  const truth::Truth truth = madeUpTruth();
  const StateErrors start = errorsOf(truth, wrongAt(truth, 0, 800, 5));   // 160
  const StateErrors even = errorsOf(truth, wrongAt(truth, 0, 800, 10));   // 80
  const StateErrors bad = errorsOf(truth, wrongAt(truth, 0, 1000, 5));    // 200
  const StateErrors end = errorsOf(truth, wrongAt(truth, 800, 1300, 5));  // 100
  const BudgetRecord budget =
      attributeError(ladderOf({"even", "bad"}), {"atlas", "noon", 0.001, tiling},
                     {start, even, end}, {start, bad, end});
  EXPECT_DOUBLE_EQ(budget.total.value, 0.1);
  ASSERT_EQ(budget.causes.size(), 2U);
  EXPECT_EQ(budget.causes[0].name, "even");
  EXPECT_DOUBLE_EQ(budget.causes[0].forward.value, 80.0 / budgetSamples);
  EXPECT_DOUBLE_EQ(budget.causes[1].forward.value, -20.0 / budgetSamples);
  EXPECT_DOUBLE_EQ(budget.causes[1].backward.value, -40.0 / budgetSamples);
  EXPECT_DOUBLE_EQ(budget.causes[0].backward.value, 100.0 / budgetSamples);
  EXPECT_DOUBLE_EQ(restNamed(budget, "distant").value, 20.0 / budgetSamples);
  EXPECT_DOUBLE_EQ(restNamed(budget, "other").value, 80.0 / budgetSamples);
  EXPECT_DOUBLE_EQ(orderDependence(budget), 20.0 / budgetSamples);
  EXPECT_EQ(budget.blocks, 400U);
  EXPECT_EQ(budget.light, "noon");
  ASSERT_EQ(budget.forward.size(), 3U);
  EXPECT_DOUBLE_EQ(budget.forward[1].errorRate, 80.0 / budgetSamples);
  EXPECT_DOUBLE_EQ(budget.forward[2].falseLight, 20.0 / budgetSamples);
  EXPECT_DOUBLE_EQ(budget.forward[2].falseShadow, 80.0 / budgetSamples);
  EXPECT_DOUBLE_EQ(budget.backward[1].errorRate, 200.0 / budgetSamples);
  for (const BudgetCause& cause : budget.causes) {
    for (const BudgetShare* share : {&cause.forward, &cause.backward}) {
      ASSERT_TRUE(share->interval) << share->reason;
      EXPECT_TRUE(share->interval->holds(share->value));
    }
  }
}

/// Each wrong sample counts once, in the first of the regions that it is in.
TEST(Budget, WhatIsLeftIsSplitByRegion) {
  truth::Truth truth = madeUpTruth();
  truth.crossesSeam.assign(budgetSamples, 0);
  for (std::size_t i = 1400; i < budgetSamples; ++i) truth.regions[i] = truth::Region::global;
  // Lit, distant and global samples, 100 of each.
  for (const std::size_t first : {1000U, 1300U, 1500U}) {
    for (std::size_t i = first; i < first + 100; ++i) truth.crossesSeam[i] = 1;
  }
  const StateErrors all = errorsOf(truth, wrongAt(truth, 0, budgetSamples, 1));
  const BudgetRecord budget =
      attributeError(ladderOf({}), {"atlas", "noon", 0, tiling}, {all}, {all});
  EXPECT_DOUBLE_EQ(restNamed(budget, "global").value, 200.0 / budgetSamples);
  EXPECT_DOUBLE_EQ(restNamed(budget, "distant").value, 200.0 / budgetSamples);
  EXPECT_DOUBLE_EQ(restNamed(budget, "seam").value, 100.0 / budgetSamples);
  EXPECT_DOUBLE_EQ(restNamed(budget, "other").value, 1100.0 / budgetSamples);
}

/// To rounding: whatever the masks, weights and lights.
TEST(Budget, PartsAddUpToTheTotal) {
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> uniform(0.1, 2);
  const truth::Truth truth = madeUpTruth();
  std::vector<double> weights(budgetSamples);
  for (double& weight : weights) weight = uniform(generator);
  const auto random = [&] {
    Mask mask = truth.mask;
    for (Shade& shade : mask.samples) {
      shade = generator() % 3 == 0 ? Shade::shadowed : Shade::lit;
    }
    StateErrors errors = stateErrors(mask, truth, weights, tiling);
    errors += stateErrors(truth.mask, truth, weights, tiling);
    return errors;
  };
  for (int k = 0; k < 5; ++k) {
    const StateErrors start = random();
    const StateErrors end = random();
    const BudgetRecord budget = attributeError(
        ladderOf({"a", "b", "c", "d"}), {"atlas", "all", 0, tiling},
        {start, random(), random(), random(), end}, {start, random(), random(), random(), end});
    EXPECT_NEAR(sumOf(budget, &BudgetCause::forward), budget.total.value, 1e-15);
    EXPECT_NEAR(sumOf(budget, &BudgetCause::backward), budget.total.value, 1e-15);
    EXPECT_NEAR(budget.total.value,
                budget.forward.front().falseShadow + budget.forward.front().falseLight, 1e-12);
  }
}

TEST(Budget, TellsWhatCannotBeToldFromNone) {
  const truth::Truth truth = madeUpTruth();
  const StateErrors start = errorsOf(truth, wrongAt(truth, 0, 1200, 3));  // 400, everywhere
  const StateErrors some =
      errorsOf(truth, wrongAt(truth, 480, 1200, 3));  // 240, right in six rows of blocks
  const StateErrors none = errorsOf(truth, truth.mask);
  const auto first = [&](double uncertainty) {
    return attributeError(ladderOf({"some", "all"}), {"atlas", "noon", uncertainty, tiling},
                          {start, some, none}, {start, none, none});
  };
  const BudgetRecord sure = first(0.001);
  EXPECT_NEAR(sure.causes[0].forward.value, 0.1, 1e-15);
  EXPECT_TRUE(isDistinguishable(sure.causes[0].forward.verdict));
  EXPECT_TRUE(isDistinguishable(sure.causes[1].forward.verdict));
  // The same share where the truth is no surer than that.
  EXPECT_FALSE(isDistinguishable(first(0.101).causes[0].forward.verdict));
  EXPECT_TRUE(isDistinguishable(first(0.101).causes[1].forward.verdict));
  // In the other order nothing is left for it, and no interval.
  EXPECT_EQ(sure.causes[0].backward.value, 0);
  EXPECT_FALSE(isDistinguishable(sure.causes[0].backward.verdict));
  EXPECT_FALSE(isDistinguishable(restNamed(sure, "distant").verdict));
}

/// A large share that one place alone has is not sure: another draw of the bumps may lack it. The
/// place is two blocks wide, a tenth of the view.
TEST(Budget, OnePlaceIsNoEvidence) {
  const truth::Truth truth = madeUpTruth();
  Mask mask = truth.mask;
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x)
      mask.samples[static_cast<std::size_t>(samplesPerSide * y + x)] = Shade::shadowed;
  }
  const StateErrors none = errorsOf(truth, truth.mask);
  const BudgetRecord budget =
      attributeError(ladderOf({"a"}), {"atlas", "noon", 0, tiling}, {errorsOf(truth, mask), none},
                     {errorsOf(truth, mask), none});
  EXPECT_DOUBLE_EQ(budget.causes[0].forward.value, 0.01);
  ASSERT_TRUE(budget.causes[0].forward.interval);
  EXPECT_TRUE(budget.causes[0].forward.interval->holds(0));
  EXPECT_FALSE(isDistinguishable(budget.causes[0].forward.verdict));
}

TEST(Budget, RefusesStatesThatDoNotFitTheCauses) {
  const truth::Truth truth = madeUpTruth();
  const StateErrors none = errorsOf(truth, truth.mask);
  EXPECT_THROW(attributeError(ladderOf({"a"}), {}, {none}, {none, none}), InternalError);
  EXPECT_THROW(attributeError(ladderOf({"a"}), {}, {none, none}, {none}), InternalError);
}

}  // namespace
}  // namespace gnomon::study
