#include "viewer/session/truth_worker.h"

#include <algorithm>
#include <chrono>
#include <span>

#include "common/error.h"
#include "model/field_lines.h"
#include "report/pictures/displaced_image.h"
#include "truth/displaced_picture.h"
#include "truth/shadow_tracer.h"
#include "truth/surface_horizons.h"

namespace gnomon::app {
namespace {

constexpr int coarsest = 8;

/// A stretch of the order as a grid of four columns: the tracer's packets are then the order's
/// tiles.
surface::SampleGrid packedGrid(const surface::SampleGrid& all,
                               std::span<const std::uint32_t> order) {
  constexpr std::size_t columns = 4;
  const std::size_t rows = (order.size() + columns - 1) / columns;
  surface::SampleGrid grid{columns, static_cast<int>(rows),
                           std::vector<surface::SurfaceSample>(columns * rows)};
  std::transform(order.begin(), order.end(), grid.samples.begin(),
                 [&](std::uint32_t index) { return all.samples[index]; });
  return grid;
}

/// One view on its way to the full resolution.
class GrowingTruth {
 public:
  GrowingTruth(const TruthView& view, const ProgressiveOrder& order, const TruthRequest& request)
      : order_(order), request_(request) {
    const surface::SampleGrid& grid = *view.samples;
    truth_ = {view.mesh,
              view.samples,
              {grid.width, grid.height, std::vector<Shade>(grid.samples.size(), Shade::none)},
              {},
              std::vector<std::uint8_t>(grid.samples.size(), 0),
              0,
              order.samples.size()};
  }

  /// Traces one level, and publishes what there is from time to time.
  void trace(std::size_t level, const std::shared_ptr<const TracedMesh>& traced,
             const TruthTracer::Worker::Job& job) {
    constexpr std::size_t samplesAtOnce = 16384;
    const Progress progress = job.progress("Tracing");
    const std::size_t end = order_.levelEnds[level];
    while (truth_.tracedCount < end) {
      progress(truth_.share());
      add(std::min(samplesAtOnce, end - truth_.tracedCount), *traced);
      if (Clock::now() - published_ > std::chrono::milliseconds(250)) publish(traced, job);
    }
    publish(traced, job);
  }

 private:
  using Clock = std::chrono::steady_clock;

  void add(std::size_t count, const TracedMesh& traced) {
    const SceneData& scene = *request_.scene;
    const auto asked = std::span(order_.samples).subspan(truth_.tracedCount, count);
    const truth::Truth found = truth::traceShadows(
        *scene.surface, scene.study->relief, traced.mesh, traced.scene,
        packedGrid(*truth_.samples, asked),
        {request_.light, scene.study->bake.settings.radiusTexels, truth::standardRayOffset});
    for (std::size_t i = 0; i < count; ++i) {
      truth_.mask.samples[asked[i]] = found.mask.samples[i];
      truth_.traced[asked[i]] = 1;
    }
    truth_.tracedCount += count;
  }

  void publish(const std::shared_ptr<const TracedMesh>& traced,
               const TruthTracer::Worker::Job& job) {
    truth_.preview = previewMask(*truth_.samples, truth_.mask, truth_.traced, coarsest);
    TruthResult result;
    result.truth = truth_;
    result.traced = traced;
    job.publish(std::move(result));
    published_ = Clock::now();
  }

  const ProgressiveOrder& order_;
  const TruthRequest& request_;
  PartialTruth truth_;
  Clock::time_point published_ = Clock::now();
};

image::Image seenSurface(const TracedMesh& traced, Camera camera, const Vec3& light, int step,
                         const Progress& progress) {
  camera.width = std::max(1, camera.width / step);
  camera.height = std::max(1, camera.height / step);
  return report::displacedImage(
      camera.width, camera.height,
      truth::displacedPicture(traced.mesh, traced.scene, camera, light, progress));
}

std::shared_ptr<const CurvaturePicture> curvaturePicture(const SceneData& scene,
                                                         const surface::SampleGrid& samples,
                                                         const Vec3& light) {
  CurvatureField field = curvatureAlong(*scene.surface, samples, light);
  CurvaturePicture picture{
      {samples.width, samples.height, {}}, std::move(field.defined), field.largest};
  picture.image.rgb.reserve(3 * field.values.size());
  for (const double value : field.values) {
    const image::Rgb colour = curvatureColour(value, field.largest);
    picture.image.rgb.insert(picture.image.rgb.end(), colour.begin(), colour.end());
  }
  return std::make_shared<const CurvaturePicture>(std::move(picture));
}

bool isAsked(const TruthRequest& request,
             const std::shared_ptr<const surface::SampleGrid>& samples) {
  return std::any_of(request.views.begin(), request.views.end(),
                     [&](const TruthView& view) { return view.samples == samples; });
}

}  // namespace

const ProgressiveOrder& TruthTracer::orderOf(
    const std::shared_ptr<const surface::SampleGrid>& samples) {
  for (const auto& [of, order] : orders_) {
    if (of == samples) return order;
  }
  return orders_.emplace_back(samples, progressiveOrder(*samples, coarsest)).second;
}

void TruthTracer::build(const SceneData& scene, const Worker::Job& job) {
  if (traced_ && traced_->key == scene.keys.truth) return;
  traced_.reset();  // the old one goes before the new one comes
  traced_ = std::make_shared<const TracedMesh>(scene, job.progress("Displacing the surface"),
                                               job.progress("Building the hierarchy"));
}

void TruthTracer::publish(const Worker::Job& job, TruthResult result) const {
  result.traced = traced_;
  job.publish(std::move(result));
}

void TruthTracer::trace(const TruthRequest& request, const Worker::Job& job) {
  const SceneData& scene = *request.scene;
  try {
    build(scene, job);
    publish(job, {});
    for (const AnglesRequest& asked : request.angles) {
      horizon::AngleTable table = truth::shootHorizons(
          *scene.surface, scene.study->relief, traced_->mesh, traced_->scene, asked.texels,
          asked.bake.settings.azimuths, asked.bake.angleLimit, job.progress("Shooting horizons"));
      table.originX = asked.origin.x;
      table.originY = asked.origin.y;
      TruthResult result;
      result.angles = {asked.label, asked.key, std::move(table)};
      publish(job, std::move(result));
    }
    orders_.erase(std::remove_if(orders_.begin(), orders_.end(),
                                 [&](const auto& order) { return !isAsked(request, order.first); }),
                  orders_.end());
    for (const TruthView& view : request.views) (void)orderOf(view.samples);
    std::vector<GrowingTruth> truths;
    for (const TruthView& view : request.views) {
      truths.emplace_back(view, orderOf(view.samples), request);
    }
    std::size_t level = 0;
    for (int stride = coarsest; stride >= 1; stride /= 2, ++level) {
      for (GrowingTruth& truth : truths) truth.trace(level, traced_, job);
      TruthResult result;
      if (level == 0 && request.curvature) {
        result.curvature = curvaturePicture(scene, *request.curvature, request.light);
      }
      if (request.picture) {
        result.picture = seenSurface(*traced_, *request.picture, request.light, stride,
                                     job.progress("Looking at the displaced surface"));
      }
      if (result.picture || result.curvature) publish(job, std::move(result));
    }
  } catch (const std::exception& error) {
    TruthResult result;
    result.error = error.what();
    job.publish(std::move(result));
  }
}

}  // namespace gnomon::app
