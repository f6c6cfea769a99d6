#include "study/run/scene/method_outcome.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "common/alongside.h"
#include "common/parallel.h"
#include "compare/bins.h"
#include "compare/boundaries.h"
#include "study/run/scene/cast_lengths.h"
#include "truth/seam_crossing.h"

namespace gnomon {
namespace {

Counts countRegion(const Mask& mask, const ViewCase& seen, const Truth& truth, Region region) {
  std::vector<std::uint8_t> selected(mask.size());
  std::transform(truth.regions.begin(), truth.regions.end(), selected.begin(),
                 [region](Region r) { return static_cast<std::uint8_t>(r == region); });
  return countSamples(mask, truth.mask, seen.weights, selected);
}

/// Adds what compares one answer with the truth. All references outlive the parts.
void addParts(std::vector<std::function<void()>>& parts, const Mask& mask, const ViewCase& seen,
              const Truth& truth, const LightField& field, AnswerOutcome& outcome) {
  outcome.regions.resize(outcomeRegions().size());
  parts.emplace_back([&] { outcome.lengths = castLengths(mask, truth, field); });
  parts.emplace_back(
      [&] { outcome.boundaries = compareBoundaries(mask, truth.mask, seen.layout); });
  parts.emplace_back(
      [&] { outcome.regions.front() = countSamples(mask, truth.mask, seen.weights); });
  for (std::size_t r = 0; r < reportedRegions.size(); ++r) {
    parts.emplace_back(
        [&, r] { outcome.regions[r + 1] = countRegion(mask, seen, truth, reportedRegions[r]); });
  }
  parts.emplace_back([&] {
    outcome.regions.back() = countSamples(mask, truth.mask, seen.weights, truth.crossesSeam);
  });
}

}  // namespace

const std::vector<std::string_view>& outcomeRegions() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> list = {"all"};
    for (const Region region : reportedRegions) list.push_back(regionName(region));
    list.push_back(seamRegion);
    return list;
  }();
  return names;
}

const OutcomeStage::Shared* OutcomeStage::findShared(const BaseCase& base) const {
  const auto found = std::find_if(shared_.begin(), shared_.end(),
                                  [&](const Shared& shared) { return shared.base == &base; });
  return found != shared_.end() ? &*found : nullptr;
}

const OutcomeStage::Shared& OutcomeStage::makeShared(const BaseCase& base, LightField field) {
  SampleBins bins = scene_.clock.measure("bins", [&](const Progress&) {
    return scene_.cache.remember(scene_.keys.bins(base.choice, view_, light_), [&] {
      return binSamples(scene_.surface, scene_.study.relief, base.views[view_].samples,
                        scene_.study.lights[light_].direction());
    });
  });
  shared_.push_back({&base, std::move(field), std::move(bins)});
  return shared_.back();
}

MethodOutcome OutcomeStage::compare(const BaseCase& base,
                                    const std::function<const MethodAnswers&()>& answersOf) {
  const Shared* known = findShared(base);
  const MethodAnswers* answers = nullptr;
  LightField field;
  // Where OpenGL draws in software it compiles on one thread.
  alongside([&] { answers = &answersOf(); },
            [&] {
              if (known == nullptr) field = scene_.lightField(base, view_, light_);
            });
  const Shared& shared = known != nullptr ? *known : makeShared(base, std::move(field));
  const ViewCase& seen = base.views[view_];
  const Truth& truth = seen.truths[light_];
  const std::vector<SampleAxis>& axes = sampleAxes();
  const bool isSame = answers->drawn.samples == answers->test.samples;
  MethodOutcome outcome;
  outcome.bins.resize(axes.size());
  // The longest first.
  std::vector<std::function<void()>> parts;
  addParts(parts, answers->drawn, seen, truth, shared.field, outcome.drawn);
  if (!isSame) addParts(parts, answers->test, seen, truth, shared.field, outcome.test);
  for (std::size_t a = 0; a < axes.size(); ++a) {
    parts.emplace_back([&, a] {
      outcome.bins[a] = countBins(answers->drawn, truth.mask, shared.bins[a],
                                  axes[a].edges.size() + 1, seen.weights);
    });
  }
  parts.emplace_back(
      [&] { outcome.blocks = blockErrors(answers->drawn, truth.mask, cellSide_, seen.weights); });
  scene_.clock.measure("compare", [&](const Progress&) {
    parallelFor(0, parts.size(), [&](std::size_t i) { parts[i](); });
  });
  if (isSame) outcome.test = outcome.drawn;
  return outcome;
}

}  // namespace gnomon
