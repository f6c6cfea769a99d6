#include "study/truth_study.h"

#include "relief/stored_bake.h"
#include "study/environment.h"
#include "study/file_names.h"
#include "study/refine_stage.h"

namespace gnomon {

StudyRecord traceStudy(RunScene& scene, const GlContext& gl,
                       const std::function<void(const TracedSurface&)>& whileTraced) {
  StudyRecord record = startRecord(scene.study, gl);
  scene.standardBase();
  {
    const TruthSurface made = makeTruthSurface(scene);
    record.truth = recordOf(made, scene.study);
    record.undefinedSamples = traceTruths(scene, *made.surface);
    if (whileTraced) whileTraced(*made.surface);
  }  // the fine mesh goes before the coarse one comes
  traceUncertainty(scene, record.truth);
  record.timings = scene.clock.timings();
  return record;
}

StoredHorizons bakeStudyTables(const StudySpec& study, const Progress& progress) {
  return bakeStoredHorizons(study.relief.field, study.bake.settings, study.bake.bits, progress);
}

CaseNames caseNames(const StudySpec& study) {
  std::vector<std::string> views, lights;
  for (const ViewSpec& view : study.views) views.push_back(view.name);
  for (const LightSpec& light : study.lights) lights.push_back(light.name);
  return {fileNames(views), fileNames(lights)};
}

}  // namespace gnomon
