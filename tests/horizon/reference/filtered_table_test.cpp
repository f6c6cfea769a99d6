#include "horizon/reference/filtered_table.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace gnomon::horizon {
namespace {

constexpr TableShape shape{5, 4, 6, relief::Wrap::repeat};

std::vector<float> entries(const TableShape& of) {
  std::mt19937 random(3);
  std::vector<float> values(static_cast<std::size_t>(of.width * of.height * of.layers));
  for (float& value : values) value = static_cast<float>(random() % 1000) / 100;
  return values;
}

double entry(const std::vector<float>& values, int x, int y, int m) {
  return values[static_cast<std::size_t>((m * shape.height + y) * shape.width + x)];
}

TEST(FilteredTable, IsTheEntryAtATexelCentreInItsAzimuth) {
  const std::vector<float> values = entries(shape);
  const StoredTable table = storeTable(values, TableBits::thirtyTwo);
  for (int m = 0; m < shape.layers; ++m) {
    for (int y = 0; y < shape.height; ++y) {
      for (int x = 0; x < shape.width; ++x) {
        const Vec2 centre(x + 0.5, y + 0.5);
        const double azimuth = 2 * pi * m / shape.layers;
        EXPECT_NEAR(filteredValue(table, shape, centre, azimuth), entry(values, x, y, m), 1e-12);
        // A turn and a whole map on.
        EXPECT_NEAR(filteredValue(table, shape, centre - Vec2(10, 8), azimuth - 4 * pi),
                    entry(values, x, y, m), 1e-12);
      }
    }
  }
}

/// Trilinear: a function that is linear in x, y and azimuth comes back.
TEST(FilteredTable, IsLinearInAllThreeAxes) {
  const TableShape clamped{8, 8, 8, relief::Wrap::clamp};
  std::vector<float> values;
  for (int m = 0; m < 8; ++m) {
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 8; ++x) values.push_back(static_cast<float>(2 * x - y + 4 * m));
    }
  }
  const StoredTable table = storeTable(values, TableBits::thirtyTwo);
  for (const Vec2 at : {Vec2(0.5, 0.5), Vec2(3.3, 6.1), Vec2(7.5, 2.9)}) {
    for (const double place : {0.0, 2.25, 6.999}) {
      EXPECT_NEAR(filteredValue(table, clamped, at, 2 * pi * place / 8),
                  2 * (at.x - 0.5) - (at.y - 0.5) + 4 * place, 1e-9);
    }
    // From the last azimuth on, it goes back to the first.
    EXPECT_NEAR(filteredValue(table, clamped, at, 2 * pi * 7.5 / 8),
                2 * (at.x - 0.5) - (at.y - 0.5) + 4 * 3.5, 1e-9);
  }
  EXPECT_NEAR(filteredValue(table, clamped, Vec2(-9, 99), 0), -7, 1e-9);
}

}  // namespace
}  // namespace gnomon::horizon
