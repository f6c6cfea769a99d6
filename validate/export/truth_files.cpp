#include "export/truth_files.h"

#include <fmt/core.h>

#include <algorithm>

#include "image/images.h"
#include "image/share_picture.h"
#include "report/json/json_values.h"
#include "report/pictures/region_image.h"

namespace gnomon::exporting {
namespace {

std::string regionFile(const study::CaseNames& names, std::size_t view, std::size_t light) {
  return fmt::format("regions/{}_{}.png", names.views[view], names.lights[light]);
}

report::Json regionCountsJson(const truth::Truth& truth) {
  report::Json counts = report::Json::object();
  for (const truth::Region region : truth::reportedRegions) {
    counts[std::string(truth::regionName(region))] =
        std::count(truth.regions.begin(), truth.regions.end(), region);
  }
  return counts;
}

report::Json caseJson(study::RunScene& scene, const study::StudyRecord& record,
                      const study::CaseNames& names, std::size_t view, std::size_t light) {
  const truth::Truth& truth = scene.standardBase().views[view].truths[light];
  const auto count = [&](Shade shade) {
    return std::count(truth.mask.samples.begin(), truth.mask.samples.end(), shade);
  };
  const study::UncertaintyRecord& flip =
      record.truth.flips.at(view * scene.study.lights.size() + light);
  report::Json json = {{"view", scene.study.views[view].name},
                       {"light", scene.study.lights[light].name},
                       {"width", truth.mask.width},
                       {"height", truth.mask.height},
                       {"mask", truthMaskFile(names, view, light)},
                       {"regions", regionFile(names, view, light)},
                       {"lit", count(Shade::lit)},
                       {"shadowed", count(Shade::shadowed)},
                       {"undefined_samples", truth.undefinedSamples},
                       {"region_samples", regionCountsJson(truth)},
                       {"uncertainty", report::jsonNumber(flip.flipRate, "cases.uncertainty")}};
  if (truth.isSoft()) json["shares"] = truthShareFile(names, view, light);
  return json;
}

/// Calls `visit(view, light)` for every case of the study.
template <typename Visit>
void forEachCase(const study::StudySpec& study, const Visit& visit) {
  for (std::size_t v = 0; v < study.views.size(); ++v) {
    for (std::size_t l = 0; l < study.lights.size(); ++l) visit(v, l);
  }
}

}  // namespace

std::string truthMaskFile(const study::CaseNames& names, std::size_t view, std::size_t light) {
  return fmt::format("masks/{}_{}_truth.png", names.views[view], names.lights[light]);
}

std::string truthShareFile(const study::CaseNames& names, std::size_t view, std::size_t light) {
  return fmt::format("shares/{}_{}_truth.exr", names.views[view], names.lights[light]);
}

void writeTruthMask(report::RunFolder& folder, const truth::Truth& truth,
                    const std::string& maskFile, const std::string& shareFile) {
  if (truth.isSoft()) {
    folder.write(maskFile, image::sharePng(truth.visibility));
    folder.write(shareFile, image::shareExr(truth.visibility));
  } else {
    folder.write(maskFile, image::pngOf(image::maskImage(truth.mask)));
  }
}

void writeTruthMasks(report::RunFolder& folder, study::RunScene& scene) {
  const study::CaseNames names = study::caseNames(scene.study);
  forEachCase(scene.study, [&](std::size_t v, std::size_t l) {
    writeTruthMask(folder, scene.standardBase().views[v].truths[l], truthMaskFile(names, v, l),
                   truthShareFile(names, v, l));
  });
}

void writeTruth(report::RunFolder& folder, study::RunScene& scene,
                const study::StudyRecord& record) {
  writeTruthMasks(folder, scene);
  const study::CaseNames names = study::caseNames(scene.study);
  report::Json cases = report::Json::array();
  forEachCase(scene.study, [&](std::size_t v, std::size_t l) {
    folder.write(regionFile(names, v, l),
                 image::pngOf(report::regionImage(scene.standardBase().views[v].truths[l])));
    cases.push_back(caseJson(scene, record, names, v, l));
  });
  const report::Json json = {{"schema", "gnomon-truth/1"},
                             {"study", report::jsonStudy(record)},
                             {"environment", report::jsonEnvironment(record.environment)},
                             {"truth", report::jsonTruth(record.truth)},
                             {"region_colours", report::jsonRegionColours()},
                             {"cases", std::move(cases)},
                             {"undefined_samples", record.undefinedSamples},
                             {"notices", record.notices}};
  folder.finish(report::jsonText(json));
}

}  // namespace gnomon::exporting
