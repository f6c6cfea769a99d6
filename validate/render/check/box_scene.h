#pragma once

#include <array>
#include <vector>

#include "render/check/rectangles.h"
#include "render/passes/drawing.h"

namespace gnomon::render::check {

/// The box over the floor (rectangles.h) on the GPU, without relief, under one light.
class BoxScene {
 public:
  BoxScene();

  /// From outside, and from within the box's shadow, below it.
  [[nodiscard]] static const std::array<Camera, 2>& cameras();
  /// Unit vector toward the light.
  [[nodiscard]] static const Vec3& light();

  [[nodiscard]] RenderView view(const Camera& camera) const {
    return cameraView(camera, mesh_.mesh);
  }
  [[nodiscard]] Drawing drawing() const {
    return {gpu_,    heights_, relief::Wrap::repeat, relief::HeightSpace::world, 1,
            light(), &volumes_};
  }

 private:
  displaced::DisplacedMesh mesh_;
  GpuMesh gpu_;
  GpuVolumes volumes_;
  GpuHeights heights_;
};

/// What a camera of the scene sees, in closed form.
inline std::vector<SeenPoint> seenPoints(const Camera& camera) {
  return render::seenPoints(camera, BoxScene::light());
}

}  // namespace gnomon::render::check
