#include "study/run/scene/stage_clock.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <thread>

namespace gnomon::study {
namespace {

void sleepMilliseconds(int milliseconds) {
  std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
}

TEST(StageClock, AddsUpAStageThatRunsTwice) {
  StageClock clock({});
  for (int i = 0; i < 2; ++i)
    clock.measure("truth", [](const Progress&) { sleepMilliseconds(20); });
  clock.measure("bake", [](const Progress&) {});
  ASSERT_EQ(clock.timings().size(), 2U);
  EXPECT_EQ(clock.timings()[0].stage, "truth");
  EXPECT_GE(clock.timings()[0].seconds, 0.040);
  EXPECT_EQ(clock.timings()[1].stage, "bake");
  EXPECT_LT(clock.timings()[1].seconds, 0.040);
}

TEST(StageClock, HandsBackWhatTheWorkReturns) {
  StageClock clock({});
  int value = 3;
  int& same = clock.measure("work", [&](const Progress&) -> int& { return value; });
  EXPECT_EQ(&same, &value);
}

TEST(StageClock, TellsTheStageWithItsShares) {
  std::vector<std::pair<std::string, double>> told;
  StageClock clock([&](std::string_view stage, double share) { told.emplace_back(stage, share); });
  clock.measure("truth", [](const Progress& progress) { progress(0.5); });
  EXPECT_EQ(told, (std::vector<std::pair<std::string, double>>{{"truth", 0}, {"truth", 0.5}}));
}

TEST(StageClock, CountsAStageThatFails) {
  StageClock clock({});
  EXPECT_THROW(clock.measure("bake", [](const Progress&) { throw std::runtime_error("no"); }),
               std::runtime_error);
  ASSERT_EQ(clock.timings().size(), 1U);
}

}  // namespace
}  // namespace gnomon::study
