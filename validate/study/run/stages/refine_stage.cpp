#include "study/run/stages/refine_stage.h"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "common/error.h"
#include "study/run/scene/cached_fields.h"
#include "truth/visibility_tracer.h"

namespace gnomon::study {
namespace {

constexpr double mostTriangles = 1e9;
constexpr const char* stage = "refinement";

/// The largest uncertainty of any view and light that two levels' truths tell.
double largestUncertainty(const ViewTruths& fine, const ViewTruths& coarse) {
  double largest = 0;
  for (std::size_t v = 0; v < fine.size(); ++v) {
    for (std::size_t l = 0; l < fine[v].size(); ++l) {
      largest = std::max(largest, truth::uncertaintyOf(fine[v][l], coarse[v][l]));
    }
  }
  return largest;
}

std::string reachedText(double wanted, const std::vector<RefinementRecord>& path) {
  std::string text = fmt::format("truth.uncertainty = {} is not reached: ", wanted);
  if (path.empty() || !path.back().flipRate) return text + "no two levels can be compared";
  return text + fmt::format("{:.3g} at a step of {} texels ({} micro-triangles)",
                            *path.back().flipRate, path.back().stepTexels,
                            path.back().microTriangles);
}

/// A surface at the end of a search.
struct RefinedSurface {
  std::unique_ptr<const TracedSurface> surface;
  std::vector<RefinementRecord> path;
};

class Refinement {
 public:
  explicit Refinement(RunScene& scene)
      : scene_(scene), wanted_(scene.study.truth.uncertainty.value()) {}

  RefinedSurface run() {
    for (double step = 1;; step /= 2) {
      auto surface = surfaceAt(step);
      const std::uint64_t triangles = surface->mesh.triangleCount();
      // Where a face is smaller than a step, both levels may be the same: no second resolution.
      const bool isFiner = !path_.empty() && triangles >= 2 * path_.back().microTriangles;
      path_.push_back({step, triangles, std::nullopt});
      if (isFiner) {
        path_.back().flipRate = largestUncertainty(
            traceStandardBase(scene_, *surface, rayFineness(scene_.study), stage), coarse_);
        if (*path_.back().flipRate <= wanted_) return {std::move(surface), std::move(path_)};
      }
      coarse_ = traceStandardBase(scene_, *surface, coarserRays(scene_.study), stage);
    }
  }

 private:
  std::unique_ptr<const TracedSurface> surfaceAt(double step) const {
    truth::MicroMeshSettings settings = scene_.study.truth.ofMesh();
    settings.stepTexels = step;
    if (!path_.empty() && 4 * static_cast<double>(path_.back().microTriangles) > mostTriangles) {
      throw InputError(
          fmt::format("{}; the next level has more than {:.0e}. Set a larger "
                      "truth.uncertainty, or truth.step",
                      reachedText(wanted_, path_), mostTriangles));
    }
    try {
      return std::make_unique<const TracedSurface>(scene_, settings, stage, stage);
    } catch (const MemoryError& error) {
      throw MemoryError(
          fmt::format("{}. The next level: {}", reachedText(wanted_, path_), error.what()));
    } catch (const InputError& error) {
      throw InputError(
          fmt::format("{}. The next level: {}", reachedText(wanted_, path_), error.what()));
    }
  }

  RunScene& scene_;
  double wanted_;
  std::vector<RefinementRecord> path_;
  ViewTruths coarse_;
};

cache::ContentKey pathKey(const RunScene& scene) {
  return cache::KeyBuilder("refinement").add("surface", scene.keys.surface()).key();
}

}  // namespace

TruthSurface::TruthSurface(RunScene& scene)
    : scene_(scene), surface_([this] {
        // A search leaves its path too, which the store does not have.
        if (scene_.study.truth.uncertainty) return make();
        return heldSurface(scene_, scene_.keys.surface(), [this] { return make(); });
      }) {}

/// Whether it is known how the step was found.
bool TruthSurface::findPath() {
  if (!path_.empty()) return true;
  auto kept = scene_.cache.find<std::vector<RefinementRecord>>(pathKey(scene_));
  if (kept) path_ = std::move(*kept);
  return !path_.empty();
}

std::shared_ptr<const TracedSurface> TruthSurface::make() {
  truth::MicroMeshSettings settings = scene_.study.truth.ofMesh();
  if (scene_.study.truth.uncertainty) {
    if (!findPath()) {
      RefinedSurface refined = Refinement(scene_).run();
      path_ = std::move(refined.path);
      scene_.cache.keep(pathKey(scene_), path_);
      return std::shared_ptr<const TracedSurface>(std::move(refined.surface));
    }
    settings.stepTexels = path_.back().stepTexels;
  }
  return std::make_shared<const TracedSurface>(scene_, settings, "micro-mesh", "hierarchy");
}

TruthRecord TruthSurface::record() {
  TruthRecord truth = sizesOf(scene_, surface_);
  truth.wantedUncertainty = scene_.study.truth.uncertainty;
  if (!truth.wantedUncertainty) return truth;
  if (!findPath()) (void)surface_.get();  // whose search leaves it
  truth.refinement = path_;
  return truth;
}

}  // namespace gnomon::study
