#include "export/truth_files.h"

#include <fmt/core.h>

#include <algorithm>

#include "image/images.h"
#include "report/json/json_values.h"
#include "report/pictures/region_image.h"

namespace gnomon {
namespace {

std::string regionFile(const CaseNames& names, std::size_t view, std::size_t light) {
  return fmt::format("regions/{}_{}.png", names.views[view], names.lights[light]);
}

Json regionCountsJson(const Truth& truth) {
  Json counts = Json::object();
  for (const Region region : reportedRegions) {
    counts[std::string(regionName(region))] =
        std::count(truth.regions.begin(), truth.regions.end(), region);
  }
  return counts;
}

Json caseJson(RunScene& scene, const StudyRecord& record, const CaseNames& names, std::size_t view,
              std::size_t light) {
  const Truth& truth = scene.standardBase().views[view].truths[light];
  const auto count = [&](Shade shade) {
    return std::count(truth.mask.samples.begin(), truth.mask.samples.end(), shade);
  };
  const UncertaintyRecord& flip = record.truth.flips.at(view * scene.study.lights.size() + light);
  return {{"view", scene.study.views[view].name},
          {"light", scene.study.lights[light].name},
          {"width", truth.mask.width},
          {"height", truth.mask.height},
          {"mask", truthMaskFile(names, view, light)},
          {"regions", regionFile(names, view, light)},
          {"lit", count(Shade::lit)},
          {"shadowed", count(Shade::shadowed)},
          {"undefined_samples", truth.undefinedSamples},
          {"region_samples", regionCountsJson(truth)},
          {"uncertainty", jsonNumber(flip.flipRate, "cases.uncertainty")}};
}

/// Calls `visit(view, light)` for every case of the study.
template <typename Visit>
void forEachCase(const StudySpec& study, const Visit& visit) {
  for (std::size_t v = 0; v < study.views.size(); ++v) {
    for (std::size_t l = 0; l < study.lights.size(); ++l) visit(v, l);
  }
}

}  // namespace

std::string truthMaskFile(const CaseNames& names, std::size_t view, std::size_t light) {
  return fmt::format("masks/{}_{}_truth.png", names.views[view], names.lights[light]);
}

void writeTruthMasks(RunFolder& folder, RunScene& scene) {
  const CaseNames names = caseNames(scene.study);
  forEachCase(scene.study, [&](std::size_t v, std::size_t l) {
    folder.write(truthMaskFile(names, v, l),
                 pngOf(maskImage(scene.standardBase().views[v].truths[l].mask)));
  });
}

void writeTruth(RunFolder& folder, RunScene& scene, const StudyRecord& record) {
  writeTruthMasks(folder, scene);
  const CaseNames names = caseNames(scene.study);
  Json cases = Json::array();
  forEachCase(scene.study, [&](std::size_t v, std::size_t l) {
    folder.write(regionFile(names, v, l),
                 pngOf(regionImage(scene.standardBase().views[v].truths[l])));
    cases.push_back(caseJson(scene, record, names, v, l));
  });
  const Json json = {{"schema", "gnomon-truth/1"},
                     {"study", jsonStudy(record)},
                     {"environment", jsonEnvironment(record.environment)},
                     {"truth", jsonTruth(record.truth)},
                     {"region_colours", jsonRegionColours()},
                     {"cases", std::move(cases)},
                     {"undefined_samples", record.undefinedSamples},
                     {"notices", record.notices}};
  folder.finish(jsonText(json));
}

}  // namespace gnomon
