#include "horizon/angle_table.h"

#include <gtest/gtest.h>

#include <cmath>

#include "truth/truth_scenes.h"

namespace gnomon::horizon {
namespace {

using test::stepRelief;

HorizonTables tableOf(RawVector<float> slopes) {
  HorizonTables tables;
  tables.width = static_cast<int>(slopes.size());
  tables.height = 1;
  tables.layers = 1;
  tables.horizon = std::move(slopes);
  return tables;
}

TEST(AngleTable, AnglesAreOffTheNormal) {
  const AngleTable table = horizonAngles(tableOf({0, 1, -1, 1e20F, -1e20F}), pi, 1);
  EXPECT_FLOAT_EQ(table.angles[0], static_cast<float>(pi / 2));
  EXPECT_FLOAT_EQ(table.angles[1], static_cast<float>(pi / 4));
  EXPECT_FLOAT_EQ(table.angles[2], static_cast<float>(3 * pi / 4));
  EXPECT_NEAR(table.angles[3], 0, 1e-6);
  EXPECT_NEAR(table.angles[4], pi, 1e-6);
}

TEST(AngleTable, EndsAtItsLimit) {
  const AngleTable table = horizonAngles(tableOf({0, 1, -0.1F, -5}), pi / 2, 1);
  EXPECT_FLOAT_EQ(table.angles[1], static_cast<float>(pi / 4));
  for (const std::size_t i : {0U, 2U, 3U}) {
    EXPECT_FLOAT_EQ(table.angles[i], static_cast<float>(pi / 2));
  }
  EXPECT_DOUBLE_EQ(table.limit, pi / 2);
  EXPECT_FLOAT_EQ(horizonAngles(tableOf({1}), 0.5, 1).angles[0], 0.5F);
}

TEST(AngleTable, AreOfTheSlopesInTheirFrame) {
  const AngleTable table = horizonAngles(tableOf({0, 0.25F, -0.25F}), pi, 4);
  EXPECT_FLOAT_EQ(table.angles[0], static_cast<float>(pi / 2));
  EXPECT_FLOAT_EQ(table.angles[1], static_cast<float>(pi / 4));
  EXPECT_FLOAT_EQ(table.angles[2], static_cast<float>(3 * pi / 4));
}

TEST(AngleTable, OfAWallIsItsElevation) {
  const relief::Relief wall = stepRelief(32, 4, 6, [](int i, int) { return i < 8; });
  const HorizonTables tables = bakeHorizons(wall.field, {4, 64});
  const AngleTable table = horizonAngles(tables, pi / 2, 1);
  EXPECT_EQ(table.width, 32);
  EXPECT_EQ(table.height, 4);
  EXPECT_EQ(table.layers, 4);
  EXPECT_EQ(table.wrap, relief::Wrap::clamp);
  EXPECT_EQ(table.originX, 0);
  EXPECT_EQ(table.originY, 0);
  for (int x = 8; x < 32; ++x) {
    // Toward -x, azimuth 2 of 4: the edge of the wall's top at x = 7.5, 6 above the floor.
    const auto at = [&](int m) {
      return table.angles[static_cast<std::size_t>((m * 4 + 2) * 32 + x)];
    };
    EXPECT_NEAR(at(2), std::atan2(x + 0.5 - 7.5, 6), 1e-6);
    EXPECT_NEAR(at(0), pi / 2, 1e-6);
  }
}

}  // namespace
}  // namespace gnomon::horizon
