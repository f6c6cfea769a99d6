#include "report/text/number_text.h"

#include <gtest/gtest.h>

#include <limits>

#include "common/error.h"

namespace gnomon::report {
namespace {

TEST(NumberText, PercentHasTwoDecimals) {
  EXPECT_EQ(percentText(0.098), "9.80");
  EXPECT_EQ(percentText(1.0), "100.00");
  EXPECT_EQ(percentText(0.00005), "0.01");
}

TEST(NumberText, OnlyZeroReadsAsZero) {
  EXPECT_EQ(percentText(0.0), "0.00");
  EXPECT_EQ(percentText(0.00004), "<0.01");
  EXPECT_EQ(percentText(1e-300), "<0.01");
}

TEST(NumberText, OnlyAllReadsAsAll) {
  EXPECT_EQ(percentText(0.99996), ">99.99");
  EXPECT_EQ(percentText(0.9999), "99.99");
  EXPECT_EQ(correlationText(1.0), "1.000");
  EXPECT_EQ(correlationText(0.99951), ">0.999");
  EXPECT_EQ(correlationText(0.9994), "0.999");
  EXPECT_EQ(correlationText(-0.99951), "<−0.999");
  EXPECT_EQ(correlationText(-1.0), "−1.000");
  EXPECT_EQ(correlationText(-0.25), "−0.250");
  EXPECT_EQ(correlationText(-1e-9), "0.000");
}

TEST(NumberText, SignsShares) {
  EXPECT_EQ(signedPercent(0.0123), "+1.23");
  EXPECT_EQ(signedPercent(-0.0123), "−1.23");
  EXPECT_EQ(signedPercent(0), "0.00");
  EXPECT_EQ(signedPercent(-1e-6), "−<0.01");
}

TEST(NumberText, RatiosHaveTwoDecimals) {
  EXPECT_EQ(ratioText(1.0), "1.00");
  EXPECT_EQ(ratioText(12.346), "12.35");
  EXPECT_EQ(ratioText(0.0), "0.00");
  EXPECT_EQ(ratioText(0.004), "<0.01");
  EXPECT_THROW(ratioText(std::numeric_limits<double>::infinity()), InternalError);
}

TEST(NumberText, UndefinedIsADash) {
  EXPECT_EQ(ratioText(std::nullopt), "–");
  EXPECT_EQ(percentText(std::nullopt), "–");
  EXPECT_EQ(correlationText(std::nullopt), "–");
}

TEST(NumberText, NotFiniteIsAnError) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_THROW(percentText(nan), InternalError);
  EXPECT_THROW(exactText(infinite), InternalError);
  EXPECT_THROW(requireFinite(-infinite, "x"), InternalError);
  EXPECT_EQ(requireFinite(-1.5, "x"), -1.5);
}

TEST(NumberText, ThousandsAreApart) {
  EXPECT_EQ(groupedText(0), "0");
  EXPECT_EQ(groupedText(999), "999");
  EXPECT_EQ(groupedText(1000), "1\u202f000");
  EXPECT_EQ(groupedText(33'554'432), "33\u202f554\u202f432");
}

}  // namespace
}  // namespace gnomon::report
