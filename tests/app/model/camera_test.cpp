#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "common/error.h"
#include "model/light_angles.h"
#include "model/picking.h"

namespace gnomon::app {
namespace {

Camera someCamera() {
  Camera camera;
  camera.eye = {3, -205, 275};
  camera.target = {0, -4, -2};
  camera.up = {0, 0.1, 2};
  return camera;
}

double distanceOf(const Camera& camera) {
  return glm::distance(camera.eye, camera.target);
}

double elevationOf(const Camera& camera) {
  const Vec3 up = glm::normalize(camera.up);
  return std::asin(glm::dot(glm::normalize(camera.eye - camera.target), up));
}

TEST(Orbit, ByAnAngleAndBackReturns) {
  const Camera camera = someCamera();
  for (const double azimuth : {-2.0, 0.3, 5.0}) {
    for (const double elevation : {-1.5, 0.0, 0.4}) {
      const Camera there = orbited(camera, azimuth, elevation);
      EXPECT_GT(glm::distance(there.eye, camera.eye), 1);
      EXPECT_LT(glm::distance(orbited(there, -azimuth, -elevation).eye, camera.eye), 1e-10);
    }
  }
}

TEST(Orbit, TurnsByTheAnglesAsked) {
  const Camera camera = someCamera();
  EXPECT_NEAR(elevationOf(orbited(camera, 0, -0.25)), elevationOf(camera) - 0.25, 1e-12);
  EXPECT_NEAR(elevationOf(orbited(camera, 1.1, 0)), elevationOf(camera), 1e-12);
  EXPECT_LT(glm::distance(orbited(camera, 2 * pi, 0).eye, camera.eye), 1e-10);
  // Counter-clockwise seen from above: from +x toward +y.
  Camera plain;
  plain.eye = {5, 0, 0};
  plain.up = {0, 0, 1};
  EXPECT_LT(glm::distance(orbited(plain, pi / 2, 0).eye, Vec3(0, 5, 0)), 1e-12);
}

/// Any drags: never over a pole, never nearer or farther, never another picture plane.
TEST(Orbit, KeepsDistanceAndSideOfUp) {
  std::mt19937 random(7);
  const auto angle = [&] { return 8 * (static_cast<double>(random()) / 4294967296.0 - 0.5); };
  Camera camera = someCamera();
  const double distance = distanceOf(camera);
  bool reachedTop = false;
  for (int k = 0; k < 2000; ++k) {
    camera = orbited(camera, angle(), angle());
    ASSERT_NEAR(distanceOf(camera), distance, 1e-9 * distance);
    ASSERT_LE(std::abs(elevationOf(camera)), radians(89) + 1e-9);
    ASSERT_GT(glm::dot(axes(camera).up, camera.up), 0);
    reachedTop = reachedTop || elevationOf(camera) > radians(88.9);
  }
  EXPECT_TRUE(reachedTop);
  EXPECT_EQ(camera.target, someCamera().target);
  EXPECT_EQ(camera.up, someCamera().up);
}

TEST(Orbit, LeavesACameraThatIsNearerToAPoleWhereItIs) {
  Camera camera;
  camera.eye = Vec3(std::cos(radians(89.7)), 0, std::sin(radians(89.7)));
  camera.up = {0, 0, 1};
  EXPECT_NEAR(elevationOf(orbited(camera, 1, 0)), radians(89.7), 1e-9);
  EXPECT_NEAR(elevationOf(orbited(camera, 0, 1)), radians(89.7), 1e-9);
  EXPECT_NEAR(elevationOf(orbited(camera, 0, -0.5)), radians(89.7) - 0.5, 1e-9);
  camera.eye = {0, 0, 1};
  EXPECT_EQ(orbited(camera, 1, 1).eye, camera.eye);
}

TEST(Zoom, MultipliesTheDistanceWithinItsRange) {
  const Camera camera = someCamera();
  const double distance = distanceOf(camera);
  const ZoomRange wide{1e-3, 1e6};
  EXPECT_NEAR(distanceOf(zoomed(camera, 0.5, wide)), distance / 2, 1e-9);
  EXPECT_LT(glm::distance(zoomed(zoomed(camera, 1.1, wide), 1 / 1.1, wide).eye, camera.eye), 1e-9);
  EXPECT_NEAR(distanceOf(zoomed(camera, 1e-9, {2, 900})), 2, 1e-9);
  EXPECT_NEAR(distanceOf(zoomed(camera, 1e9, {2, 900})), 900, 1e-9);
  EXPECT_NEAR(elevationOf(zoomed(camera, 3, wide)), elevationOf(camera), 1e-12);
}

TEST(LightDrag, KeepsTheLightsDisc) {
  for (const double degrees : {0.0, 0.266, 0.007, 3.0, 9.999}) {
    EXPECT_EQ(dragged({165, 24, degrees}, 7, -3).radius, degrees);
  }
}

TEST(LightDrag, AndBackReturns) {
  std::mt19937 random(2);
  const auto change = [&] { return 40 * (static_cast<double>(random()) / 4294967296.0 - 0.5); };
  for (int k = 0; k < 1000; ++k) {
    const LightAngles start{165.25, 24};
    const double azimuth = 10 * change();
    const double elevation = change();
    const LightAngles there = dragged(start, azimuth, elevation);
    ASSERT_GE(there.azimuth, 0);
    ASSERT_LT(there.azimuth, 360);
    const LightAngles back = dragged(there, -azimuth, -elevation);
    EXPECT_EQ(back.azimuth, start.azimuth) << azimuth;
    EXPECT_EQ(back.elevation, start.elevation) << elevation;
  }
}

TEST(LightDrag, WrapsRoundAndEndsAtThePoles) {
  EXPECT_EQ(dragged({350, 24}, 20, 0).azimuth, 10);
  EXPECT_EQ(dragged({10, 24}, -20, 0).azimuth, 350);
  EXPECT_EQ(dragged({10, 24}, -10, 0).azimuth, 0);
  EXPECT_EQ(dragged({359.9999, 24}, 0, 0).azimuth, 0);
  EXPECT_EQ(dragged({10, 24}, 0, 100).elevation, 90);
  EXPECT_EQ(dragged({10, 24}, 0, -200).elevation, -90);
}

TEST(LightPath, GoesEvenlyFromItsStartToItsEnd) {
  const LightPath path{350, 10, 380, 70, 7};
  const double azimuths[] = {350, 355, 0, 5, 10, 15, 20};
  for (int frame = 0; frame < path.frames; ++frame) {
    const LightAngles light = lightAt(path, frame, 0.266);
    EXPECT_EQ(light.azimuth, azimuths[frame]);
    EXPECT_EQ(light.elevation, 10 + 10 * frame);
    EXPECT_EQ(light.radius, 0.266);
  }
  EXPECT_EQ(lightAt({30, 20, 90, 60, 1}, 0, 0), (LightAngles{30, 20, 0})) << "a path of one frame";
}

/// A film of it repeats: the step from the last frame to the first is like all others.
TEST(LightPath, OnceAroundLeavesOutTheFrameThatWouldRepeatTheFirst) {
  const LightPath path = parsePath("around", {165, 24, 0}, 36);
  for (int frame = 0; frame < path.frames; ++frame) {
    const LightAngles next = lightAt(path, (frame + 1) % path.frames, 0);
    EXPECT_EQ(next, dragged(lightAt(path, frame, 0), 10, 0));
  }
  // So does one of two turns the other way.
  EXPECT_EQ(lightAt({165, 24, -555, 24, 36}, 35, 0), (LightAngles{185, 24, 0}));
  EXPECT_EQ(lightAt({165, 24, 525, 30, 36}, 35, 0), (LightAngles{165, 30, 0}))
      << "a spiral does not end where it began";
  EXPECT_EQ(lightAt({165, 24, 165, 24, 36}, 35, 0), (LightAngles{165, 24, 0}));
}

TEST(LightPath, IsReadFromText) {
  EXPECT_EQ(parsePath("165,24,-20.5,60", {}, 9), (LightPath{165, 24, -20.5, 60, 9}));
  EXPECT_EQ(parsePath("around", {200, 30, 1}, 9), (LightPath{200, 30, 560, 30, 9}));
  for (const char* text : {"", "round", "1,2,3", "1,2,3,4,5", "1,2,3,", "1;2;3;4", "1,2,3,x",
                           "0,91,0,0", "0,0,0,-90.5", "0,0,4000,0", "0,0,nan,0", "0,0,inf,0"}) {
    EXPECT_THROW((void)parsePath(text, {}, 9), UsageError) << text;
  }
}

TEST(Picking, FindsEveryPixelAtItsMiddle) {
  const PaneRectangle rectangle{{17, 40}, {640, 300}};
  constexpr int width = 97;
  constexpr int height = 33;
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const Vec2 middle =
          rectangle.corner + rectangle.size * Vec2(column + 0.5, row + 0.5) / Vec2(width, height);
      EXPECT_EQ(pixelUnder(middle, rectangle, width, height), (ViewPixel{column, row}));
    }
  }
}

TEST(Picking, EndsAtTheBorder) {
  const PaneRectangle rectangle{{10, 20}, {100, 50}};
  EXPECT_EQ(pixelUnder({10, 20}, rectangle, 10, 5), (ViewPixel{0, 0}));
  EXPECT_EQ(pixelUnder({109.99, 69.99}, rectangle, 10, 5), (ViewPixel{9, 4}));
  EXPECT_FALSE(pixelUnder({9.99, 30}, rectangle, 10, 5));
  EXPECT_FALSE(pixelUnder({110, 30}, rectangle, 10, 5));
  EXPECT_FALSE(pixelUnder({50, 70}, rectangle, 10, 5));
  EXPECT_FALSE(pixelUnder({50, 30}, {{10, 20}, {0, 0}}, 10, 5));
}

TEST(Picking, GivesTheSampleOfAPixel) {
  surface::SampleGrid grid{3, 2, std::vector<surface::SurfaceSample>(6)};
  grid.samples[4] = {7, 0.25F, 0.75F};
  const auto sample = sampleUnder(grid, {1, 1});
  ASSERT_TRUE(sample);
  EXPECT_EQ(sample->face, 7);
  EXPECT_EQ(sample->t, 0.75F);
  EXPECT_FALSE(sampleUnder(grid, {0, 0}));
  for (const ViewPixel outside : {ViewPixel{-1, 0}, {3, 1}, {1, 2}, {1, -1}}) {
    EXPECT_FALSE(sampleUnder(grid, outside));
  }
}

const PaneRectangle pane{{20, 40}, {200, 100}};

std::size_t countOf(const std::vector<std::uint8_t>& pixels) {
  return std::accumulate(pixels.begin(), pixels.end(), std::size_t{0});
}

TEST(ViewPart, IsTheRectangleOfADragWhicheverWayItGoes) {
  const ViewPart expected{0.25, 0.1, 0.75, 0.6};
  for (const auto& [one, other] : {std::pair(Vec2(70, 50), Vec2(170, 100)),
                                   {Vec2(170, 100), Vec2(70, 50)},
                                   {Vec2(70, 100), Vec2(170, 50)}}) {
    EXPECT_EQ(partBetween(one, other, pane), expected);
  }
  const PaneRectangle place = placeOf(expected, pane);
  EXPECT_EQ(place.corner, Vec2(70, 50));
  EXPECT_EQ(place.size, Vec2(100, 50));
}

TEST(ViewPart, EndsAtThePane) {
  EXPECT_EQ(partBetween({120, 90}, {900, -5}, pane), (ViewPart{0.5, 0, 1, 0.5}));
  EXPECT_FALSE(partBetween({70, 50}, {70, 90}, pane)) << "no width";
  EXPECT_FALSE(partBetween({300, 50}, {400, 90}, pane)) << "beside the pane";
}

TEST(ViewPart, HoldsTheSamplesWhoseCentresLieInIt) {
  constexpr int width = 37;
  constexpr int height = 21;
  std::mt19937 random(3);
  const auto share = [&] { return static_cast<double>(random() % 1001) / 1000; };
  for (int k = 0; k < 200; ++k) {
    const auto part = partBetween({20 + 200 * share(), 40 + 100 * share()},
                                  {20 + 200 * share(), 40 + 100 * share()}, pane);
    if (!part) continue;
    const auto pixels = pixelsIn(*part, width, height);
    ASSERT_EQ(pixels.size(), static_cast<std::size_t>(width * height));
    for (int row = 0; row < height; ++row) {
      for (int column = 0; column < width; ++column) {
        const double x = (column + 0.5) / width;
        const double y = (row + 0.5) / height;
        const bool inside =
            x >= part->left && x < part->right && y >= part->top && y < part->bottom;
        ASSERT_EQ(pixels[static_cast<std::size_t>(row * width + column)], inside ? 1 : 0)
            << column << " " << row;
      }
    }
  }
}

/// The identity that makes errors of parts add up.
TEST(ViewPart, PartsWithACommonSideShareNoSampleAndLoseNone) {
  for (const double cut : {0.0, 0.1, 1.0 / 3, 0.5, 0.77, 1.0}) {
    const std::size_t left = countOf(pixelsIn({0, 0, cut, 1}, 41, 13));
    const std::size_t right = countOf(pixelsIn({cut, 0, 1, 1}, 41, 13));
    EXPECT_EQ(left + right, std::size_t{41 * 13}) << cut;
    const std::size_t upper = countOf(pixelsIn({0, 0, 1, cut}, 41, 13));
    EXPECT_EQ(upper + countOf(pixelsIn({0, cut, 1, 1}, 41, 13)), std::size_t{41 * 13}) << cut;
  }
}

}  // namespace
}  // namespace gnomon::app
