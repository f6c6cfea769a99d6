#include "study/run/stages/cost_stage.h"

#include <gtest/gtest.h>

namespace gnomon::study {
namespace {

TEST(FrameLimits, OfAllCasesOfASweepAreThoseOfFiveAtMost) {
  for (const std::size_t cases : {1, 2, 5}) {
    EXPECT_EQ(frameLimits(25, cases).milliseconds, 100) << cases;
  }
  for (const std::size_t cases : {6, 51, 1000}) {
    const double all = frameLimits(25, cases).milliseconds * static_cast<double>(cases);
    EXPECT_DOUBLE_EQ(all, 500) << cases;
  }
}

TEST(FrameLimits, HaveTheFramesThatWereAskedFor) {
  EXPECT_EQ(frameLimits(7, 51).frames, 7);
}

}  // namespace
}  // namespace gnomon::study
