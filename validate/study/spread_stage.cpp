#include "study/spread_stage.h"

#include <map>

#include "common/parallel.h"
#include "compare/bins.h"
#include "study/sample_axes.h"

namespace gnomon {
namespace {

double meanUncertainty(const TruthRecord& truth, const std::string& view) {
  double sum = 0;
  double lights = 0;
  for (const UncertaintyRecord& flip : truth.flips) {
    if (flip.view != view) continue;
    sum += flip.flipRate;
    ++lights;
  }
  return lights > 0 ? sum / lights : truth.uncertainty;
}

}  // namespace

SpreadStage::SpreadStage(RunScene& scene, std::span<const MethodCase> methods, std::size_t view)
    : scene_(scene), methods_(methods), view_(view) {
  const StudySpec& study = scene.study;
  const ViewCase& shown = scene.standardBase().views[view];
  errors_.view = study.views[view].name;
  errors_.tiling = chooseTiling(shown.truths.front().mask, shown.weights);
  for (const LightSpec& light : study.lights) errors_.lights.push_back(light.name);
  std::vector<std::vector<Counts>> none;
  for (const SampleAxis& axis : sampleAxes()) none.emplace_back(axis.edges.size() + 1);
  for (std::size_t m = 0; m < methods.size(); ++m) {
    if (!answersIn(methods[m], study.views[view])) continue;
    answering_.push_back(m);
    errors_.methods.push_back({methods[m].spec->label, {}});
    counts_.push_back(none);
  }
}

void SpreadStage::measure(std::size_t light, const std::vector<std::optional<Mask>>& masks) {
  scene_.clock.measure("bins", [&](const Progress&) {
    std::map<const BaseCase*, SampleBins> bins;
    for (const std::size_t m : answering_) {
      const BaseCase* base = methods_[m].base;
      if (bins.contains(base)) continue;
      bins.emplace(base, binSamples(scene_.surface, scene_.study.relief, base->views[view_].samples,
                                    scene_.study.lights[light].direction()));
    }
    const std::size_t axes = sampleAxes().size();
    parallelFor(0, answering_.size() * axes, [&](std::size_t i) {
      const MethodCase& method = methods_[answering_[i / axes]];
      const ViewCase& seen = method.base->views[view_];
      std::vector<Counts>& sums = counts_[i / axes][i % axes];
      const std::vector<Counts> counts =
          countBins(*masks[answering_[i / axes]], seen.truths[light].mask,
                    bins.at(method.base)[i % axes], sums.size(), seen.weights);
      for (std::size_t b = 0; b < sums.size(); ++b) sums[b] += counts[b];
    });
  });
  scene_.clock.measure("confidence", [&](const Progress&) {
    for (MethodErrors& method : errors_.methods) method.lights.emplace_back();
    parallelFor(0, answering_.size(), [&](std::size_t i) {
      const ViewCase& seen = methods_[answering_[i]].base->views[view_];
      errors_.methods[i].lights.back() = blockErrors(*masks[answering_[i]], seen.truths[light].mask,
                                                     errors_.tiling.cellSide, seen.weights);
    });
  });
}

std::vector<BinRecord> SpreadStage::bins() const {
  std::vector<BinRecord> records;
  for (std::size_t m = 0; m < counts_.size(); ++m) {
    for (std::size_t a = 0; a < sampleAxes().size(); ++a) {
      const SampleAxis& axis = sampleAxes()[a];
      for (std::size_t b = 0; b <= axis.edges.size(); ++b) {
        const Counts& counts = counts_[m][a][b];
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
    append(record.differences, differencesOf(errors_, meanUncertainty(record.truth, errors_.view)));
  });
  append(record.bins, bins());
}

}  // namespace gnomon
