#include "common/camera.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

Camera skewCamera() {
  Camera camera;
  camera.eye = {3, -7, 5};
  camera.target = {-1, 2, 0.5};
  camera.up = {0.2, 0.1, 1};
  camera.verticalFov = radians(40);
  camera.width = 6;
  camera.height = 4;
  return camera;
}

double angle(const Vec3& a, const Vec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

TEST(Camera, AxesAreARightHandedOrthonormalFrame) {
  const CameraAxes axis = axes(skewCamera());
  EXPECT_NEAR(glm::length(axis.right), 1, 1e-14);
  EXPECT_NEAR(glm::length(axis.up), 1, 1e-14);
  EXPECT_NEAR(glm::dot(axis.right, axis.up), 0, 1e-14);
  EXPECT_NEAR(glm::length(glm::cross(axis.right, axis.up) - axis.back), 0, 1e-14);
  EXPECT_GT(glm::dot(axis.up, skewCamera().up), 0);
}

TEST(Camera, RaysMeanToTheViewingDirection) {
  const Camera camera = skewCamera();
  const CameraAxes axis = axes(camera);
  // The picture's centre is the corner that the four middle pixels share.
  Vec3 sum(0);
  for (const int row : {1, 2}) {
    for (const int column : {2, 3}) sum += pixelDirection(camera, axis, column, row);
  }
  EXPECT_NEAR(angle(sum, camera.target - camera.eye), 0, 1e-14);
}

TEST(Camera, RowZeroIsTheTopAndColumnZeroTheLeft) {
  const Camera camera = skewCamera();
  const CameraAxes axis = axes(camera);
  const Vec3 first = pixelDirection(camera, axis, 0, 0);
  EXPECT_GT(glm::dot(first, axis.up), 0);
  EXPECT_LT(glm::dot(first, axis.right), 0);
}

TEST(Camera, FieldOfViewIsTheFullVerticalAngleAndPixelsAreSquare) {
  Camera camera = skewCamera();
  camera.width = 3000;
  camera.height = 2000;
  const CameraAxes axis = axes(camera);
  const Vec3 top = pixelDirection(camera, axis, 1500, 0);
  // Half a pixel inside the edge of the picture: tan(fov / 2) (1 - 1 / height).
  const double tangent = std::tan(radians(20));
  EXPECT_NEAR(glm::dot(top, axis.up) / -glm::dot(top, axis.back), tangent * (1 - 1 / 2000.0),
              1e-12);
  const Vec3 right = pixelDirection(camera, axis, 2999, 1000);
  EXPECT_NEAR(glm::dot(right, axis.right) / -glm::dot(right, axis.back),
              1.5 * tangent * (1 - 1 / 3000.0), 1e-12);
}

}  // namespace
}  // namespace gnomon
