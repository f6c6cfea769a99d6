#include "model/orbit.h"

#include <gtest/gtest.h>

#include <random>

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

}  // namespace
}  // namespace gnomon::app
