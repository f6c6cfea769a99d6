#include "report/tables/confidence.h"

#include <gtest/gtest.h>

namespace gnomon::report {
namespace {

TEST(TruthText, StepsHaveTheDigitsTheyNeed) {
  EXPECT_EQ(stepText(0.25), "0.25");
  EXPECT_EQ(stepText(1.0 / 48), "0.02083");
}

}  // namespace
}  // namespace gnomon::report
