#include "study/run/stages/spread_stage.h"

#include <algorithm>

#include "study/run/scene/cached_fields.h"
#include "study/run/scene/sample_axes.h"

namespace gnomon::study {
namespace {

/// Of the truth in one view, one a light; the largest where a light has none of its own.
std::vector<double> uncertaintiesIn(const TruthRecord& truth, const ViewErrors& errors) {
  std::vector<double> uncertainties(errors.lights.size(), truth.uncertainty);
  for (const UncertaintyRecord& flip : truth.flips) {
    if (flip.view != errors.view) continue;
    const auto light = std::find(errors.lights.begin(), errors.lights.end(), flip.light);
    if (light == errors.lights.end()) continue;
    uncertainties[static_cast<std::size_t>(light - errors.lights.begin())] = flip.flipRate;
  }
  return uncertainties;
}

/// By the samples of the study's own base. The truth says which of them have a frame, and that is
/// the same under all lights.
compare::Tiling tilingOf(RunScene& scene, std::size_t view) {
  const BaseCase& base = scene.standardBase();
  const ViewCase& shown = base.views[view];
  cache::KeyBuilder key("tiling");
  key.add("samples", scene.keys.samples(base.choice, view)).add("surface", scene.keys.surface());
  key.add("blocks", compare::leastBlocks);
  return scene.cache.remember(
      key.key(), [&] { return compare::chooseTiling(shown.truths.front().mask, shown.weights); });
}

}  // namespace

SpreadStage::SpreadStage(RunScene& scene, std::span<const MethodCase> methods, std::size_t view)
    : scene_(scene) {
  const StudySpec& study = scene.study;
  errors_.view = study.views[view].name;
  errors_.tiling = tilingOf(scene, view);
  for (const Light& light : study.lights) errors_.lights.push_back(light.name);
  std::vector<std::vector<compare::Counts>> none;
  for (const SampleAxis& axis : sampleAxes()) none.emplace_back(axis.edges.size() + 1);
  for (std::size_t m = 0; m < methods.size(); ++m) {
    if (!answersIn(methods[m], study.views[view])) continue;
    answering_.push_back(m);
    errors_.methods.push_back({methods[m].spec->label, {}});
    counts_.push_back(none);
  }
}

void SpreadStage::add(std::size_t method, const MethodOutcome& outcome) {
  const auto found = std::find(answering_.begin(), answering_.end(), method);
  const auto i = static_cast<std::size_t>(found - answering_.begin());
  errors_.methods.at(i).lights.push_back(outcome.blocks);
  for (std::size_t a = 0; a < outcome.bins.size(); ++a) {
    for (std::size_t b = 0; b < outcome.bins[a].size(); ++b) {
      counts_[i][a][b] += outcome.bins[a][b];
    }
  }
}

std::vector<BinRecord> SpreadStage::bins() const {
  std::vector<BinRecord> records;
  for (std::size_t m = 0; m < counts_.size(); ++m) {
    for (std::size_t a = 0; a < sampleAxes().size(); ++a) {
      const SampleAxis& axis = sampleAxes()[a];
      for (std::size_t b = 0; b <= axis.edges.size(); ++b) {
        const compare::Counts& counts = counts_[m][a][b];
        if (counts.samples == 0) continue;
        BinRecord bin{errors_.methods[m].method,
                      errors_.view,
                      std::string(allLights),
                      std::string(axis.name),
                      {},
                      {},
                      counts};
        if (b > 0) bin.low = axis.edges[b - 1];
        if (b < axis.edges.size()) bin.high = axis.edges[b];
        records.push_back(std::move(bin));
      }
    }
  }
  return records;
}

void SpreadStage::report(StudyRecord& record) const {
  const auto append = [](auto& list, auto&& more) {
    list.insert(list.end(), more.begin(), more.end());
  };
  scene_.clock.measure("confidence", [&](const Progress&) {
    append(record.confidence, confidenceOf(errors_));
    append(record.differences, differencesOf(errors_, uncertaintiesIn(record.truth, errors_)));
  });
  append(record.bins, bins());
}

}  // namespace gnomon::study
