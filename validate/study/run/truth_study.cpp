#include "study/run/truth_study.h"

#include "horizon/stored_bake.h"
#include "study/run/driver_faults.h"
#include "study/run/notices.h"
#include "study/run/scene/environment.h"
#include "study/run/scene/truth_stage.h"
#include "study/spec/with_keys.h"

namespace gnomon::study {

StudyRecord traceStudy(RunScene& scene, const render::GlContext& gl,
                       const std::function<void(const TracedSurface&)>& whileTraced,
                       const std::function<void(const TracedSurface&)>& whileCoarse) {
  DriverFaults(scene.shaders, scene.cache).requireViews(scene.study);
  StudyRecord record = startRecord(scene.study, gl);
  scene.standardBase();
  {
    SurfaceOnDemand surface = truthSurface(scene);
    record.truth = sizesOf(scene, surface);
    record.undefinedSamples = traceTruths(scene, surface);
    if (whileTraced) whileTraced(surface.get());
  }  // the fine mesh goes before the coarse one comes
  traceUncertainty(scene, record.truth, whileCoarse);
  record.notices = noticesOf(scene, record.truth, {});
  record.timings = scene.clock.timings();
  return record;
}

horizon::StoredHorizons bakeStudyTables(const StudySpec& study, cache::Cache& cache,
                                        const Progress& progress) {
  const relief::HeightField& field = study.relief.field;
  const horizon::BakeSettings& settings = study.bake.settings;
  if (!keepsHorizons(field, settings)) {
    return withKeys("bake", [&] {
      return horizon::bakeStoredHorizons(field, settings, study.bake.bits, progress);
    });
  }
  const horizon::HorizonTables tables = keptHorizons(cache, field, study.bake, progress);
  return {tables, tables.radiusTexels, horizon::storeTable(tables.horizon, study.bake.bits),
          horizon::storeTable(tables.distance, study.bake.bits)};
}

}  // namespace gnomon::study
