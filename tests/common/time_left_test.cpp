#include "common/time_left.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

TEST(TimeLeft, IsThatOfTheCasesThatAreLeft) {
  // Ten seconds a case: of five two are done, the third has taken four.
  EXPECT_DOUBLE_EQ(secondsLeft(2, 5, 20, 4), 26);
  EXPECT_DOUBLE_EQ(secondsLeft(4, 5, 40, 0), 10);
  // A case that takes longer than the others did has nothing left that anyone knows of.
  EXPECT_DOUBLE_EQ(secondsLeft(2, 5, 20, 15), 20);
  EXPECT_DOUBLE_EQ(secondsLeft(4, 5, 40, 99), 0);
}

TEST(TimeLeft, ReadsInOneUnit) {
  EXPECT_EQ(durationText(0.3), "0 s");
  EXPECT_EQ(durationText(99), "99 s");
  EXPECT_EQ(durationText(99.6), "2 min");
  EXPECT_EQ(durationText(3000), "50 min");
  EXPECT_EQ(durationText(5969), "99 min");
  EXPECT_EQ(durationText(5971), "1.7 h");
  EXPECT_EQ(durationText(86400), "24.0 h");
}

}  // namespace
}  // namespace gnomon
