#include "viewer/session/truth_worker.h"

#include <algorithm>
#include <chrono>
#include <span>

#include "common/error.h"
#include "model/cross_section.h"
#include "report/view_images.h"
#include "truth/displaced_picture.h"
#include "truth/shadow_tracer.h"
#include "truth/surface_horizons.h"
#include "truth/visibility_tracer.h"

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

/// Some rows of a grid.
surface::SampleGrid rowsOf(const surface::SampleGrid& grid, int first, int end) {
  const auto at = [&](int row) {
    return grid.samples.begin() + static_cast<std::ptrdiff_t>(row) * grid.width;
  };
  return {grid.width, end - first, {at(first), at(end)}};
}

Mask rowsOf(const Mask& mask, int first, int end) {
  const auto at = [&](int row) {
    return mask.samples.begin() + static_cast<std::ptrdiff_t>(row) * mask.width;
  };
  return {mask.width, end - first, {at(first), at(end)}};
}

/// One view on its way to the full resolution.
class GrowingTruth {
 public:
  GrowingTruth(const TruthView& view, const ProgressiveOrder& order, const TruthRequest& request)
      : order_(order), request_(request) {
    const surface::SampleGrid& grid = *view.samples;
    hard_ = emptyMap<Mask>(grid.width, grid.height);
    if (isSoft()) shares_ = emptyMap<Visibility>(grid.width, grid.height);
    truth_.mesh = view.mesh;
    truth_.samples = view.samples;
    truth_.traced.assign(grid.samples.size(), 0);
    truth_.sampleCount = order.samples.size();
  }

  /// Traces one level, and publishes what there is from time to time.
  void trace(std::size_t level, const std::shared_ptr<const TracedMesh>& traced,
             const TruthTracer::Worker::Job& job) {
    constexpr std::size_t samplesAtOnce = 16384;
    const Progress progress = job.progress("Tracing the truth");
    const std::size_t end = order_.levelEnds[level];
    const bool isLast = end == order_.samples.size();
    while (hardCount_ < end) {
      progress(truth_.share());
      const auto asked =
          std::span(order_.samples).subspan(hardCount_, std::min(samplesAtOnce, end - hardCount_));
      add(asked, !isLast, *traced, progress);
      publishAtTimes(traced, job);
    }
    if (isSoft() && isLast) refine(traced, job);
    publish(traced, job);
  }

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] bool isSoft() const { return request_.light.isSoft(); }

  void mark(std::size_t sample) {
    truth_.tracedCount += truth_.traced[sample] == 0 ? 1 : 0;
    truth_.traced[sample] = 1;
  }

  [[nodiscard]] Visibility sharesOf(const surface::SampleGrid& samples, const Mask& hard,
                                    int directions, const TracedMesh& traced,
                                    const Progress& check) const {
    return truth::traceVisibility(traced.mesh, traced.scene, samples, hard,
                                  {request_.light, directions, truth::standardRayOffset},
                                  [&](double /*share*/) { check(truth_.share()); });
  }

  /// @param live  whether a disc is traced here, too
  void add(std::span<const std::uint32_t> asked, bool live, const TracedMesh& traced,
           const Progress& check) {
    const SceneData& scene = *request_.scene;
    const surface::SampleGrid grid = packedGrid(*truth_.samples, asked);
    const truth::Truth found =
        truth::traceShadows(*scene.surface, scene.study->relief, traced.mesh, traced.scene, grid,
                            truth::TraceSettings{request_.light});
    for (std::size_t i = 0; i < asked.size(); ++i) {
      hard_.samples[asked[i]] = found.mask.samples[i];
      if (!isSoft()) mark(asked[i]);
    }
    hardCount_ += asked.size();
    if (!isSoft() || !live) return;
    const Visibility shares = sharesOf(grid, found.mask, liveDirections, traced, check);
    for (std::size_t i = 0; i < asked.size(); ++i) {
      shares_.shares[asked[i]] = shares.shares[i];
      mark(asked[i]);
    }
  }

  /// The shares that a run finds. Each band is traced with rows more on both sides, since what is
  /// traced at a sample depends on its neighbours, and from an even row on, as traceVisibility
  /// asks.
  void refine(const std::shared_ptr<const TracedMesh>& traced,
              const TruthTracer::Worker::Job& job) {
    constexpr int bandRows = 32;
    const surface::SampleGrid& grid = *truth_.samples;
    const Progress progress = job.progress("Tracing the light's disc");
    for (int top = 0; top < grid.height; top += bandRows) {
      const double done = static_cast<double>(top) / grid.height;
      const int first = std::max(0, top - 2);
      const int end = std::min(grid.height, top + bandRows + 1);
      const Visibility band = sharesOf(rowsOf(grid, first, end), rowsOf(hard_, first, end),
                                       request_.scene->study->truth.directions, *traced,
                                       [&](double) { progress(done); });
      const auto width = static_cast<std::size_t>(grid.width);
      const auto rows = static_cast<std::size_t>(std::min(bandRows, grid.height - top));
      const std::size_t skipped = static_cast<std::size_t>(top - first) * width;
      const std::size_t begin = static_cast<std::size_t>(top) * width;
      for (std::size_t i = 0; i < rows * width; ++i) {
        shares_.shares[begin + i] = band.shares[skipped + i];
        if (grid.samples[begin + i].isOnSurface()) mark(begin + i);
      }
      publishAtTimes(traced, job);
    }
  }

  void publishAtTimes(const std::shared_ptr<const TracedMesh>& traced,
                      const TruthTracer::Worker::Job& job) {
    if (Clock::now() - published_ > std::chrono::milliseconds(250)) publish(traced, job);
  }

  void publish(const std::shared_ptr<const TracedMesh>& traced,
               const TruthTracer::Worker::Job& job) {
    truth_.answers = isSoft() ? Answers(shares_) : Answers(hard_);
    truth_.preview = preview(*truth_.samples, truth_.answers, truth_.traced, coarsest);
    TruthResult result;
    result.truth = truth_;
    result.traced = traced;
    job.publish(std::move(result));
    published_ = Clock::now();
  }

  const ProgressiveOrder& order_;
  const TruthRequest& request_;
  PartialTruth truth_;
  Mask hard_;  ///< of the light's centre
  std::size_t hardCount_ = 0;
  Visibility shares_;  ///< empty of a point
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
                                               job.progress("Building boxes for rays"));
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
          asked.bake.settings.azimuths, asked.bake.angleLimit, job.progress("Tracing horizons"));
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
        result.curvature = curvaturePicture(scene, *request.curvature, request.light.direction);
      }
      if (request.picture) {
        result.picture = seenSurface(*traced_, *request.picture, request.light.direction, stride,
                                     job.progress("Tracing the displaced surface"));
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
