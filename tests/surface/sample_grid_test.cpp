#include "surface/sample_grid.h"

#include "surface/shapes.h"
#include "surface/test_surfaces.h"

namespace gnomon {
namespace {

TEST(SampleAreas, OfASpherePatchSumToItsArea) {
  // Between latitudes ±φ over longitude Λ: 2 R² Λ sin φ.
  const double radius = 2, longitude = 1.5, latitude = 1.2;
  const LimitSurface surface(makeSphere(radius, longitude, latitude, 20, 16));
  constexpr int cuts = 6;
  SampleGrid grid;
  for (int face = 0; face < surface.faceCount(); ++face) {
    for (int i = 0; i < cuts * cuts; ++i) {
      grid.samples.push_back({face, static_cast<float>((i % cuts + 0.5) / cuts),
                              static_cast<float>((i / cuts + 0.5) / cuts)});
    }
  }
  grid.samples.emplace_back();  // no surface
  const std::vector<double> areas = sampleAreas(surface, grid, cuts * cuts);
  ASSERT_EQ(areas.size(), grid.samples.size());
  EXPECT_EQ(areas.back(), 0);
  double sum = 0;
  for (const double area : areas) sum += area;
  EXPECT_NEAR(sum, 2 * radius * radius * longitude * std::sin(latitude / 2), 1e-4);
}

}  // namespace
}  // namespace gnomon
