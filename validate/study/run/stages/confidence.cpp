#include "study/run/stages/confidence.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "common/parallel.h"
#include "study/judge/distinguish.h"
#include "study/run/scene/cached_fields.h"
#include "study/run/scene/view_samples.h"

namespace gnomon::study {
namespace {

compare::BlockErrors together(const MethodErrors& method) {
  compare::BlockErrors sum = method.lights.front();
  for (std::size_t l = 1; l < method.lights.size(); ++l) sum += method.lights[l];
  return sum;
}

/// One light of a view, or all of them together.
struct LightErrors {
  std::string light;
  double uncertainty = 0;
  std::vector<compare::BlockErrors> methods;
};

/// All lights together first, then, where there are several, each.
std::vector<LightErrors> byLight(const ViewErrors& errors,
                                 const std::vector<double>& uncertainties) {
  const auto lights = static_cast<double>(uncertainties.size());
  const double sum = std::accumulate(uncertainties.begin(), uncertainties.end(), 0.0);
  std::vector<LightErrors> cases = {{std::string(allLights), lights > 0 ? sum / lights : 0, {}}};
  for (const MethodErrors& method : errors.methods) cases[0].methods.push_back(together(method));
  if (errors.lights.size() < 2) return cases;
  for (std::size_t l = 0; l < errors.lights.size(); ++l) {
    cases.push_back({errors.lights[l], uncertainties.empty() ? 0 : uncertainties.at(l), {}});
    for (const MethodErrors& method : errors.methods) {
      cases.back().methods.push_back(method.lights.at(l));
    }
  }
  return cases;
}

DifferenceRecord differenceRecord(const ViewErrors& errors, const LightErrors& light,
                                  std::size_t first, std::size_t second) {
  const compare::BlockErrors& a = light.methods[first];
  const compare::BlockErrors& b = light.methods[second];
  const compare::ConfidenceInterval confidence = compare::differenceConfidence(a, b, errors.tiling);
  DifferenceRecord record;
  record.view = errors.view;
  record.light = light.light;
  record.first = errors.methods[first].method;
  record.second = errors.methods[second].method;
  record.difference = a.rate() - b.rate();
  record.interval = confidence.interval;
  record.reason = confidence.reason;
  record.uncertainty = light.uncertainty;
  record.verdict =
      distinguish({record.difference, record.interval, record.uncertainty, confidence.areEqual});
  return record;
}

}  // namespace

std::vector<ConfidenceRecord> confidenceOf(const ViewErrors& errors) {
  const std::vector<LightErrors> lights = byLight(errors, {});
  std::vector<ConfidenceRecord> records(errors.methods.size() * lights.size());
  parallelFor(0, records.size(), [&](std::size_t i) {
    const std::size_t method = i / lights.size();
    const LightErrors& light = lights[i % lights.size()];
    const compare::BlockErrors& cells = light.methods[method];
    const compare::ConfidenceInterval confidence = compare::rateConfidence(cells, errors.tiling);
    records[i] = {errors.methods[method].method,
                  errors.view,
                  light.light,
                  cells.rate(),
                  confidence.interval,
                  std::string(confidence.reason),
                  confidence.blocks,
                  errors.tiling.blockSide()};
  });
  return records;
}

std::vector<DifferenceRecord> differencesOf(const ViewErrors& errors,
                                            const std::vector<double>& uncertainties) {
  const std::vector<LightErrors> lights = byLight(errors, uncertainties);
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t first = 0; first < errors.methods.size(); ++first) {
    for (std::size_t second = first + 1; second < errors.methods.size(); ++second) {
      pairs.emplace_back(first, second);
    }
  }
  std::vector<DifferenceRecord> records(pairs.size() * lights.size());
  parallelFor(0, records.size(), [&](std::size_t i) {
    const auto [first, second] = pairs[i % pairs.size()];
    records[i] = differenceRecord(errors, lights[i / pairs.size()], first, second);
  });
  return records;
}

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
