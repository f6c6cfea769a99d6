#include "gnomon/horizon.h"

#include <gmock/gmock.h>

#include <vector>

#include "api/failure_of.h"

namespace gnomon::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

/// One texel of height 4 among 9 × 5.
std::vector<float> peak() {
  std::vector<float> texels(45, 0.0F);
  texels[2 * 9 + 6] = 4;
  return texels;
}

TEST(ApiHorizon, IsTheSlopeToTheHighestPointAndItsDistance) {
  const std::vector<float> texels = peak();
  const HorizonMaps maps = bakeHorizons({9, 5, texels, false}, 4, 100);
  ASSERT_EQ(maps.slopes.size(), 4U * 45);
  ASSERT_EQ(maps.distances.size(), 4U * 45);
  // From x = 2 the peak is 4 texels away toward +x and nothing rises the other way.
  EXPECT_FLOAT_EQ(maps.slopes[2 * 9 + 2], 1);
  EXPECT_FLOAT_EQ(maps.distances[2 * 9 + 2], 4);
  EXPECT_FLOAT_EQ(maps.slopes[2 * 45 + 2 * 9 + 2], 0);
  // From (6, 0) it is 2 texels away toward +y, the second of four azimuths.
  EXPECT_FLOAT_EQ(maps.slopes[45 + 6], 2);
}

TEST(ApiHorizon, SeesAcrossTheEdgeOfAMapThatRepeats) {
  const std::vector<float> texels = peak();
  const HorizonMaps repeated = bakeHorizons({9, 5, texels}, 2, 100);
  EXPECT_FLOAT_EQ(repeated.slopes[2 * 9 + 8], 4.0F / 7);
}

TEST(ApiHorizon, LooksNoFartherThanTheRadius) {
  const std::vector<float> texels = peak();
  const HorizonMaps maps = bakeHorizons({9, 5, texels, false}, 1, 2);
  EXPECT_FLOAT_EQ(maps.slopes[2 * 9 + 2], 0);
  EXPECT_FLOAT_EQ(maps.slopes[2 * 9 + 4], 2);
}

TEST(ApiHorizon, RefusesWhatIsNoMap) {
  const std::vector<float> texels = peak();
  EXPECT_THAT(failureOf([&] { (void)bakeHorizons({9, 6, texels}, 4, 10); }), HasSubstr("54"));
  EXPECT_THAT(failureOf([&] {
                (void)bakeHorizons({9, 5, texels}, 0, 10);
              }),
              StartsWith("horizons: azimuths: 0 found"));
  EXPECT_THAT(failureOf([&] {
                (void)bakeHorizons({9, 5, texels}, 4, -1);
              }),
              StartsWith("horizons: radius: -1 found"));
}

}  // namespace
}  // namespace gnomon::test
