#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <thread>

#include "common/camera.h"
#include "study/run/scene/environment.h"
#include "study/run/scene/view_samples.h"
#include "surface/base_mesh.h"
#include "truth/truth_scenes.h"

namespace gnomon::study {
namespace {

using test::cubeCage;

void sleepMilliseconds(int milliseconds) {
  std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
}

TEST(StageClock, AddsUpAStageThatRunsTwice) {
  StageClock clock({});
  for (int i = 0; i < 2; ++i)
    clock.measure("truth", [](const Progress&) { sleepMilliseconds(20); });
  clock.measure("bake", [](const Progress&) {});
  ASSERT_EQ(clock.timings().size(), 2U);
  EXPECT_EQ(clock.timings()[0].stage, "truth");
  EXPECT_GE(clock.timings()[0].seconds, 0.040);
  EXPECT_EQ(clock.timings()[1].stage, "bake");
  EXPECT_LT(clock.timings()[1].seconds, 0.040);
}

TEST(StageClock, HandsBackWhatTheWorkReturns) {
  StageClock clock({});
  int value = 3;
  int& same = clock.measure("work", [&](const Progress&) -> int& { return value; });
  EXPECT_EQ(&same, &value);
}

TEST(StageClock, TellsTheStageWithItsShares) {
  std::vector<std::pair<std::string, double>> told;
  StageClock clock([&](std::string_view stage, double share) { told.emplace_back(stage, share); });
  clock.measure("truth", [](const Progress& progress) { progress(0.5); });
  EXPECT_EQ(told, (std::vector<std::pair<std::string, double>>{{"truth", 0}, {"truth", 0.5}}));
}

TEST(StageClock, CountsAStageThatFails) {
  StageClock clock({});
  EXPECT_THROW(clock.measure("bake", [](const Progress&) { throw std::runtime_error("no"); }),
               std::runtime_error);
  ASSERT_EQ(clock.timings().size(), 1U);
}

constexpr int width = 30;
constexpr int height = 20;
constexpr int cut = 14;  ///< the last column before the break

/// What a camera straight above the middle of a plane 100 wide and 60 high sees, a hundredth of it
/// a pixel: the right part as if it were moved by some pixels.
surface::SampleGrid pixelsOfPlane(int shift) {
  surface::SampleGrid grid{width, height, {}};
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const double x = column - width / 2 + 0.5 + (column > cut ? shift : 0);
      const double y = height / 2 - row - 0.5;
      grid.samples.push_back(
          {0, static_cast<float>(0.5 + x / 100), static_cast<float>(0.5 + y / 60)});
    }
  }
  return grid;
}

compare::SampleLayout layoutInCamera(const surface::SampleGrid& samples) {
  const surface::LimitSurface plane(surface::makePlane(100, 60, 1, 1));
  Camera camera;
  camera.width = width;
  camera.height = height;
  // A pixel is one unit.
  camera.eye = {0, 0, height / (2 * std::tan(camera.verticalFov / 2))};
  const render::RenderView view =
      render::cameraView(camera, surface::makeBaseMesh(plane, Vec2(1), 1));
  return makeSampleLayout(plane, Vec2(7), camera, view, samples);
}

TEST(ViewMap, IsAnImageWithoutBreaksInACamera) {
  const compare::SampleLayout layout = layoutInCamera(pixelsOfPlane(0));
  EXPECT_EQ(layout.columnStep, 1);
  EXPECT_EQ(layout.rowStep, 1);
  EXPECT_EQ(layout.tileSide, 0);
  ASSERT_EQ(layout.breaks.size(), std::size_t{width * height});
  EXPECT_EQ(std::count(layout.breaks.begin(), layout.breaks.end(), 0), width * height);
}

TEST(ViewMap, BreaksWhereTheSurfaceLeapsInACamera) {
  // Neighbours reach 3 × (1 + 1) pixels.
  for (const int shift : {4, 6, -8, 20}) {
    const compare::SampleLayout layout = layoutInCamera(pixelsOfPlane(shift));
    const bool leaps = std::abs(shift + 1) > 6;
    for (std::size_t i = 0; i < layout.breaks.size(); ++i) {
      EXPECT_EQ(layout.breaks[i], leaps && i % width == cut ? compare::breakRight : 0)
          << shift << ", " << i;
    }
  }
}

TEST(ViewMap, BreaksBetweenRowsToo) {
  surface::SampleGrid samples = pixelsOfPlane(0);
  for (std::size_t i = width * 5; i < samples.samples.size(); ++i) samples.samples[i].t -= 0.25F;
  const compare::SampleLayout layout = layoutInCamera(samples);
  for (std::size_t i = 0; i < layout.breaks.size(); ++i) {
    EXPECT_EQ(layout.breaks[i], i / width == 4 ? compare::breakBelow : 0) << i;
  }
}

TEST(ViewMap, KnowsNothingOfWhatIsNotShown) {
  surface::SampleGrid samples = pixelsOfPlane(20);
  for (std::size_t i = 0; i < samples.samples.size(); ++i) {
    if (i % width == cut) samples.samples[i].face = -1;
  }
  const compare::SampleLayout layout = layoutInCamera(samples);
  EXPECT_EQ(std::count(layout.breaks.begin(), layout.breaks.end(), 0), width * height);
}

TEST(ViewMap, OfAnAtlasIsInTexels) {
  // A face has 400 / 10 by 60 / 6 texels.
  const surface::LimitSurface plane(surface::makePlane(100, 60, 10, 6));
  const compare::SampleLayout layout =
      makeSampleLayout(plane, Vec2(400, 60), AtlasSpec{8}, render::atlasView(plane, 8), {});
  EXPECT_NEAR(layout.columnStep, 40 / 8.0, 1e-12);
  EXPECT_NEAR(layout.rowStep, 10 / 8.0, 1e-12);
  EXPECT_EQ(layout.tileSide, 0);
  EXPECT_TRUE(layout.breaks.empty());
  // A sphere's faces differ in size but not in texels.
  const surface::LimitSurface ball(surface::makeSphere(60, 1.6, 1.2, 20, 15));
  const compare::SampleLayout round =
      makeSampleLayout(ball, Vec2(128, 64), AtlasSpec{3}, render::atlasView(ball, 3), {});
  EXPECT_NEAR(round.columnStep, 128 / 20.0 / 3, 1e-9);
  EXPECT_NEAR(round.rowStep, 64 / 15.0 / 3, 1e-9);
}

TEST(ViewMap, HasTilesWhereTheChartIsNoGrid) {
  const surface::LimitSurface cube(cubeCage());
  EXPECT_EQ(makeSampleLayout(cube, Vec2(64), AtlasSpec{6}, render::atlasView(cube, 6), {}).tileSide,
            6);
}

}  // namespace
}  // namespace gnomon::study
