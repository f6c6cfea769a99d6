#include "surface/sample_grid.h"

#include "surface/cage/shapes.h"
#include "surface/test_surfaces.h"

namespace gnomon::surface {
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
  const std::vector<double> areas = sampleAreas(surface, grid, cuts);
  ASSERT_EQ(areas.size(), grid.samples.size());
  EXPECT_EQ(areas.back(), 0);
  double sum = 0;
  for (const double area : areas) sum += area;
  EXPECT_NEAR(sum, 2 * radius * radius * longitude * std::sin(latitude / 2), 1e-4);
}

TEST(SampleAreas, AreThoseOfTheGridAndFloatsHoldThem) {
  const LimitSurface surface(makeSphere(2, 1.5, 1.2, 20, 16));
  SampleGrid grid, shaken;
  for (int i = 0; i < 81; ++i) {
    const SurfaceSample sample{7, static_cast<float>((i % 9 + 0.5) / 9),
                               static_cast<float>((i / 9 + 0.5) / 9)};
    grid.samples.push_back(sample);
    shaken.samples.push_back({7, sample.s + (i % 2 == 0 ? 1e-5F : -1e-5F), sample.t - 1e-5F});
  }
  const std::vector<double> areas = sampleAreas(surface, grid, 9);
  EXPECT_EQ(sampleAreas(surface, shaken, 9), areas) << "as another mesh's rasteriser rounds them";
  EXPECT_NE(areas.front(), areas.back());
  for (std::size_t i = 0; i < areas.size(); ++i) {
    EXPECT_EQ(static_cast<double>(static_cast<float>(areas[i])), areas[i]);
    const SurfaceSample& sample = grid.samples[i];
    const TangentPoint point = surface.tangentPoint(7, sample.s, sample.t);
    EXPECT_NEAR(areas[i] * 81 / glm::length(glm::cross(point.ds, point.dt)), 1, 1e-5);
  }
}

}  // namespace
}  // namespace gnomon::surface
