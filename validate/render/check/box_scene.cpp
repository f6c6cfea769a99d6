#include "render/check/box_scene.h"

namespace gnomon::render::check {
namespace {

Camera boxCamera(const Vec3& eye, const Vec3& target, double fov) {
  Camera camera;
  camera.eye = eye;
  camera.target = target;
  camera.up = {0, 0, 1};
  camera.verticalFov = radians(fov);
  camera.width = 96;
  camera.height = 80;
  return camera;
}

}  // namespace

BoxScene::BoxScene()
    : mesh_(boxOverFloorMesh()),
      gpu_(mesh_.mesh),
      volumes_(mesh_),
      heights_(relief::HeightField(2, 2, {0, 0, 0, 0}, relief::Wrap::repeat)) {}

const std::array<Camera, 2>& BoxScene::cameras() {
  static const std::array cameras = {boxCamera({-10, -9, 10}, {-2, 1, 1.5}, 42),
                                     boxCamera({-2.7, 1.8, 1}, {4, -3, 0.6}, 90)};
  return cameras;
}

const Vec3& BoxScene::light() {
  static const Vec3 light = glm::normalize(Vec3(0.45, -0.35, 0.82));
  return light;
}

}  // namespace gnomon::render::check
