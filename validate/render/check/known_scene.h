#pragma once

#include <array>
#include <vector>

#include "common/camera.h"
#include "render/bakes/bake_pass.h"
#include "render/gpu_scene.h"
#include "render/passes/method_pass.h"

// The scene that a driver is checked with: a floor and a box that floats over it, seven rectangles
// whose picture and shadow rays have closed forms, with maps of random zeros and ones.

namespace gnomon::render::check {

constexpr int tileSide = 8;           ///< texels, and samples of the atlas, of a face's side
constexpr int azimuths = 4;           ///< of the horizon and distance tables
constexpr glm::ivec2 mapSize{64, 8};  ///< texels; seven faces side by side, and a place to spare

/// A sample of a view, by rays.
struct KnownPoint {
  int face = -1;          ///< of what the sample shows; -1 for nothing. The floor is face 0
  Vec2 st{0, 0};          ///< its place on the face
  double facing = 0;      ///< the cosine of the angle between the face's outside and the light
  bool isHidden = false;  ///< another face is in front of the light, or the outside is turned away
  /// Whether rounding cannot change the answer: a pixel and its eight neighbours show the same face
  /// and are lit alike. Of the atlas, every sample.
  bool isClear = false;
  glm::ivec2 texel{0, 0};  ///< of an atlas's sample: x + 8 face, y
  double bumped = 0;       ///< of an atlas's sample: as `facing`, of the normal bent by the relief

  [[nodiscard]] bool facesAway() const { return !(facing > 0); }
};

/// A view of the scene with what it shows.
struct KnownView {
  RenderView view;
  std::vector<KnownPoint> points;
};

/// From outside, and from within the box's shadow.
const std::array<KnownView, 2>& cameraViews();
/// The seven faces side by side, one sample a texel.
const KnownView& atlasView();
/// Unit vector toward the light.
const Vec3& knownLight();

/// The scene's maps, layer after layer.
struct KnownMaps {
  std::vector<float> heights, horizon, distance, ellipse, angles;
};
const KnownMaps& knownMaps();
/// Whether a map is 1 at a texel, which may lie one beyond its end.
bool bitOf(const std::vector<float>& map, int layer, glm::ivec2 texel);

/// The scene on the GPU, with tables in one number of bits.
class KnownScene {
 public:
  explicit KnownScene(horizon::TableBits bits = horizon::TableBits::thirtyTwo);

  [[nodiscard]] Drawing drawing() const {
    return {
        gpu_,      heights_, relief::Wrap::repeat, relief::HeightSpace::world, 1, {knownLight()},
        &volumes_, &texture_};
  }
  [[nodiscard]] GpuTables tables() const { return {&horizon_, &distance_, &angles_, &ellipse_}; }
  [[nodiscard]] BakeScene bakeScene() const {
    return {heights_, relief::Wrap::repeat, relief::HeightSpace::world, 1};
  }

 private:
  displaced::DisplacedMesh mesh_;
  GpuMesh gpu_;
  GpuVolumes volumes_;
  RenderView texture_;
  GpuHeights heights_;
  GpuTable horizon_, distance_, ellipse_;
  GpuAngles angles_;
};

}  // namespace gnomon::render::check
