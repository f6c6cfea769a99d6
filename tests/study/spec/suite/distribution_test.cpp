#include "study/spec/suite/distribution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "study/spec/suite/exact_degrees.h"
#include "support/error_messages.h"

namespace gnomon::study {
namespace {
using ::testing::HasSubstr;

Distribution drawnFrom(const std::string& value) {
  const toml::table table = parseTomlText("x = " + value, "suite.toml");
  return readDistribution(TomlReader(table, "suite.toml", ""), "x");
}

TEST(Distribution, StepsAreTheirDecimals) {
  const std::vector<double> values = drawnFrom("{ from = -0.3, to = 0.3, step = 0.1 }").values();
  EXPECT_EQ(values, (std::vector<double>{-0.3, -0.2, -0.1, 0, 0.1, 0.2, 0.3}));
}

TEST(Distribution, ProgressionIsGeometricAndEndsWhereItSays) {
  const std::vector<double> values = drawnFrom("{ log = [0.005, 0.2] }").values();
  ASSERT_EQ(values.size(), 1025U);
  EXPECT_EQ(values.front(), 0.005);
  EXPECT_EQ(values.back(), 0.2);
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double exact = 0.005 * std::pow(40, static_cast<double>(k) / 1024);
    EXPECT_NEAR(values[k], exact, 6e-4 * exact);
    EXPECT_EQ(values[k], roundedNumber(values[k]));
  }
}

TEST(Distribution, ValuesAreEquallyProbable) {
  const Distribution three = drawnFrom("{ among = [1, 2, 4] }");
  RandomStream random(1);
  std::map<double, int> counts;
  for (int i = 0; i < 30000; ++i) ++counts[three.draw(random)];
  ASSERT_EQ(counts.size(), 3U);
  // Four standard deviations of a count.
  for (const auto& [value, count] : counts) EXPECT_NEAR(count, 10000, 4 * 82) << value;
}

TEST(Distribution, RefusesWhatIsNone) {
  const auto said = [](const std::string& value) {
    return messageOf<InputError>([&] { (void)drawnFrom(value); });
  };
  EXPECT_THAT(said("{ log = [0, 1] }"), HasSubstr("suite.toml:1: x.log"));
  EXPECT_THAT(said("{ log = [2, 1] }"), HasSubstr("two rising numbers expected"));
  EXPECT_THAT(said("{ from = 0, to = 1, step = 0.3 }"), HasSubstr("whole number of steps"));
  EXPECT_THAT(said("{ from = 0, to = 1 }"), HasSubstr("x.step"));
  EXPECT_THAT(said("{ amog = [1] }"), HasSubstr("unknown key"));
  EXPECT_THAT(said("\"3\""), HasSubstr("number"));
}

TEST(RoundedNumber, HasFourDigits) {
  EXPECT_EQ(roundedNumber(0.0123456), 0.01235);
  EXPECT_EQ(roundedNumber(-98765.4), -98770);
  EXPECT_EQ(roundedNumber(3), 3);
  EXPECT_FALSE(std::signbit(roundedNumber(-0.0)));
}

/// The generator's published numbers: splitmix64 from 0, and xoshiro256** from 1, 2, 3, 4.
TEST(RandomStream, IsTheOneThatItSays) {
  RandomStream random({1, 2, 3, 4});
  EXPECT_EQ(random.next(), 11520U);
  EXPECT_EQ(random.next(), 0U);
  EXPECT_EQ(random.next(), 1509978240U);
  EXPECT_EQ(random.next(), 1215971899390074240U);
  RandomStream filled(
      {0xE220A8397B1DCDAFU, 0x6E789E6AA1B965F4U, 0x06C45D188009454FU, 0xF88BB8A8724C81ECU});
  RandomStream seeded(std::uint64_t{0});
  for (int i = 0; i < 10; ++i) EXPECT_EQ(seeded.next(), filled.next());
}

TEST(RandomStream, CountsAndShares) {
  RandomStream random(7);
  double sum = 0;
  for (int i = 0; i < 10000; ++i) {
    EXPECT_LT(random.below(3), 3U);
    const double unit = random.unit();
    EXPECT_GE(unit, 0);
    EXPECT_LT(unit, 1);
    sum += unit;
  }
  EXPECT_NEAR(sum / 10000, 0.5, 0.012);
}

TEST(ExactDegrees, AgreeWithTheLibrary) {
  for (double degrees = -720; degrees <= 720; degrees += 0.5) {
    const SineCosine exact = sineCosine(degrees);
    EXPECT_NEAR(exact.sine, std::sin(radians(degrees)), 3e-15) << degrees;
    EXPECT_NEAR(exact.cosine, std::cos(radians(degrees)), 3e-15) << degrees;
  }
  EXPECT_EQ(sineCosine(90).cosine, 0);
  EXPECT_EQ(sineCosine(180).sine, 0);
}

}  // namespace
}  // namespace gnomon::study
