#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/camera.h"
#include "image/images.h"
#include "model/pane_figures.h"
#include "model/progressive_order.h"
#include "surface/sample_grid.h"
#include "truth/micro_mesh.h"
#include "truth/micro_scene.h"
#include "viewer/session/background_worker.h"
#include "viewer/session/scene_data.h"

namespace gnomon::app {

/// The truth, traced behind the window at rising resolution: see ProgressiveOrder. Under a light
/// with a disc every second sample a side is first traced toward `liveDirections` of it; then all
/// samples get the study's own number of directions, in bands of rows from the top.

/// How many directions the disc has while the resolution rises.
constexpr int liveDirections = 32;

/// The displaced surface in Embree.
struct TracedMesh {
  TracedMesh(const SceneData& of, const Progress& meshing, const Progress& hierarchy)
      : key(of.keys.truth),
        mesh(*of.surface, of.study->relief, of.study->truth, meshing),
        scene(mesh, hierarchy) {}
  cache::ContentKey key;  ///< SceneKeys::truth of what it was made from
  truth::MicroMesh mesh;
  truth::MicroScene scene;
};

/// The pixels of one mesh.
struct TruthView {
  study::MeshChoice mesh;
  std::shared_ptr<const surface::SampleGrid> samples;
};

/// Horizons that must be shot on the displaced surface, for one method.
struct AnglesRequest {
  std::string label;
  cache::ContentKey key;  ///< DrawnScene::anglesKey of the method that they are for
  study::BakeSpec bake;
  surface::SampleGrid texels;
  glm::ivec2 origin{0, 0};  ///< texel coordinates of the grid's lower left corner
};

struct TruthRequest {
  std::shared_ptr<const SceneData> scene;
  Light light;
  std::vector<TruthView> views;   ///< whose truth is asked
  std::optional<Camera> picture;  ///< from where the displaced surface is looked at
  std::shared_ptr<const surface::SampleGrid> curvature;  ///< where the normal curvature is asked
  std::vector<AnglesRequest> angles;
};

/// The normal curvature along the light, in colours.
struct CurvaturePicture {
  image::Image image;
  std::vector<std::uint8_t> defined;  ///< one a pixel: 1 where there is a curvature
  double largest = 0;                 ///< |κ| that the colours' ends stand for, 1 / world
};

/// A truth as far as it is traced.
struct PartialTruth {
  study::MeshChoice mesh;
  std::shared_ptr<const surface::SampleGrid> samples;
  Answers answers;                   ///< none where nothing was traced yet
  Answers preview;                   ///< to look at: every pixel has the nearest answer
  std::vector<std::uint8_t> traced;  ///< one a sample, 1 where it was asked
  std::size_t tracedCount = 0;
  std::size_t sampleCount = 0;  ///< of the view
  [[nodiscard]] double share() const {
    return sampleCount == 0 ? 1
                            : static_cast<double>(tracedCount) / static_cast<double>(sampleCount);
  }
};

/// Horizons that were asked for.
struct ShotAngles {
  std::string label;
  cache::ContentKey key;  ///< as the request's
  horizon::AngleTable table;
};

/// One of these is there, or several.
struct TruthResult {
  std::optional<PartialTruth> truth;
  std::optional<image::Image> picture;  ///< the displaced surface by its own rays, perhaps smaller
  std::shared_ptr<const CurvaturePicture> curvature;
  std::optional<ShotAngles> angles;
  std::shared_ptr<const TracedMesh> traced;  ///< what it was traced on
  std::string error;                         ///< why there is no more
};

/// Builds and traces; keeps the displaced surface as long as scenes have the same.
class TruthTracer {
 public:
  using Worker = BackgroundWorker<TruthRequest, TruthResult>;
  void trace(const TruthRequest& request, const Worker::Job& job);

 private:
  void build(const SceneData& scene, const Worker::Job& job);
  void publish(const Worker::Job& job, TruthResult result) const;

  /// The order in which a view is traced, kept while only the light moves.
  const ProgressiveOrder& orderOf(const std::shared_ptr<const surface::SampleGrid>& samples);

  std::shared_ptr<const TracedMesh> traced_;
  std::vector<std::pair<std::shared_ptr<const surface::SampleGrid>, ProgressiveOrder>> orders_;
};

}  // namespace gnomon::app
