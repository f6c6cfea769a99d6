#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "common/mask.h"
#include "compare/counts.h"
#include "compare/shadow_length.h"
#include "study/record/record.h"
#include "study/run/scene/run_scene.h"
#include "truth/micro_mesh.h"
#include "truth/micro_scene.h"
#include "truth/shadow_tracer.h"

namespace gnomon::study {

/// The displaced surface, ready to be traced.
struct TracedSurface {
  /// @param meshStage, sceneStage  of the run's clock
  /// @throws MemoryError for a mesh that cannot fit
  TracedSurface(RunScene& run, const truth::MicroMeshSettings& settings, std::string_view meshStage,
                std::string_view sceneStage);

  truth::MicroMesh mesh;
  truth::MicroScene scene;  ///< shares the mesh's vertices
};

/// A displaced surface that is built when it is first asked for: a run whose truth is in the cache
/// never does.
class SurfaceOnDemand {
 public:
  using Maker = std::function<std::shared_ptr<const TracedSurface>()>;

  explicit SurfaceOnDemand(Maker make);

  const TracedSurface& get();
  /// Frees its memory, unless the cache keeps it; `get` builds it again.
  void release() { surface_.reset(); }

 private:
  Maker make_;
  std::shared_ptr<const TracedSurface> surface_;
};

/// The surface of a key: what the cache has of it, or what `make()` returns, which is shared where
/// more cases may follow.
std::shared_ptr<const TracedSurface> tracedSurface(RunScene& scene, const cache::ContentKey& key,
                                                   const std::function<TracedSurface()>& make);

/// The surface that a study's truth is traced on, at the study's step.
/// @param scene  outlives it
SurfaceOnDemand truthSurface(RunScene& scene);

/// The sizes that a run reports of that surface.
TruthRecord sizesOf(RunScene& scene, SurfaceOnDemand& surface);

/// The first mesh of the scene whose samples in a view are a mesh's own, to the bit, if that is
/// another: in an atlas all meshes mostly show the same.
const BaseCase* baseWithSamples(const RunScene& scene, const BaseCase& base, std::size_t view);

/// Traces every view of every mesh of the scene under every light, where the cache does not have
/// it. The lights of a view are traced together; meshes that show the same samples share truths.
/// Lights with discs get their shares too: the mask of such a truth is what these are cut to.
/// @returns the number of samples for which no frame exists
/// @throws InputError for a view in which no sample has a frame
std::uint64_t traceTruths(RunScene& scene, SurfaceOnDemand& surface);

/// Traces the standard base's samples again at half the resolution and half the ray offset, and the
/// discs of lights with half as many directions: the samples that change, or by how much their
/// shares do, tell the truth's uncertainty.
/// @param truth  its step is doubled for the coarser mesh; receives the flip rates and the
///   uncertainty
/// @param whileTraced  called with the coarser surface before it goes
/// @throws InputError where the coarser mesh has more than half the triangles: too similar to tell
void traceUncertainty(RunScene& scene, TruthRecord& truth,
                      const std::function<void(const TracedSurface&)>& whileTraced = {});

/// Lengths of a mask's shadows over the truth's, of those alone that an occluder casts (regions
/// `cast`, `distant` and `global`): an attached shadow has no end to measure.
/// @throws InputError as `compareShadowLengths`
compare::ShadowLengths castLengths(const Mask& mask, const truth::Truth& truth,
                                   const compare::LightField& field);

/// The same of several masks at once. @returns one a mask
std::vector<compare::ShadowLengths> castLengths(std::span<const Mask* const> masks,
                                                const truth::Truth& truth,
                                                const compare::LightField& field);

/// All metrics of two maps of visibility: `shareMetrics`, then `penumbraMetrics`.
std::vector<compare::Metric> sharesMetrics(const Visibility& candidate, const Visibility& truth,
                                           std::span<const double> weights,
                                           const compare::LightField& field);

}  // namespace gnomon::study
