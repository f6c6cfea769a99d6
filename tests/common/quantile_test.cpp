#include "common/quantile.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

TEST(Quantile, IsAValueWhereTheShareMeetsOne) {
  const std::vector<double> sorted = {1, 2, 4, 8, 16};
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    EXPECT_EQ(quantile(sorted, 0.25 * static_cast<double>(i)), sorted[i]);
  }
}

TEST(Quantile, IsLinearBetweenValues) {
  EXPECT_DOUBLE_EQ(quantile({1, 2}, 0.5), 1.5);
  EXPECT_DOUBLE_EQ(quantile({0, 10, 20, 40}, 0.9), 34);
  EXPECT_EQ(quantile({7}, 0.3), 7);
  EXPECT_EQ(quantile({0.1, 0.1}, 0.37), 0.1) << "exact between equal values";
}

}  // namespace
}  // namespace gnomon
