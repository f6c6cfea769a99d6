#include "study/run/scene/method_outcome.h"

#include <algorithm>
#include <map>
#include <utility>

#include "common/lists.h"
#include "common/parallel.h"
#include "compare/boundaries.h"
#include "study/run/scene/truth_stage.h"
#include "truth/surface_paths.h"

namespace gnomon::study {
namespace {

/// An answer and the truth's, as masks or as maps of visibility.
template <typename Map>
struct AnswerAndTruth {
  const Map& answer;
  const Map& truth;
};

/// The counts of the regions that overlap no other, in order.
template <typename Map>
std::vector<compare::Counts> countDisjoint(const AnswerAndTruth<Map>& both, const ViewCase& seen,
                                           const truth::Truth& truth) {
  std::vector<std::uint8_t> regions(truth.regions.size());
  std::transform(truth.regions.begin(), truth.regions.end(), regions.begin(),
                 [](truth::Region region) { return static_cast<std::uint8_t>(region); });
  const auto place = [](truth::Region region) { return static_cast<std::size_t>(region); };
  const std::size_t count =
      1 + place(*std::max_element(truth::reportedRegions.begin(), truth::reportedRegions.end()));
  const std::vector<compare::Counts> all =
      compare::countClasses(both.answer, both.truth, regions, count, seen.weights);
  std::vector<compare::Counts> counts;
  counts.reserve(truth::reportedRegions.size());
  for (const truth::Region region : truth::reportedRegions) counts.push_back(all[place(region)]);
  return counts;
}

/// The counts of truth::partRegions.
/// @param parts  of every face of the surface
template <typename Map>
std::vector<compare::Counts> countParts(const AnswerAndTruth<Map>& both, const ViewCase& seen,
                                        const truth::Truth& truth, const std::vector<int>& parts,
                                        std::size_t partCount) {
  const std::size_t count = truth.regions.size();
  std::vector<std::uint8_t> receivers(count, truth::noCaster);
  std::vector<std::uint8_t> pairs(count, truth::noCaster);
  for (std::size_t i = 0; i < count; ++i) {
    const surface::SurfaceSample& sample = seen.samples.samples[i];
    if (!sample.isOnSurface()) continue;
    receivers[i] = static_cast<std::uint8_t>(parts[sample.faceIndex()]);
    if (truth.casters[i] == truth::noCaster) continue;
    pairs[i] = static_cast<std::uint8_t>(receivers[i] * partCount + truth.casters[i]);
  }
  std::vector<compare::Counts> counts =
      compare::countClasses(both.answer, both.truth, receivers, partCount, seen.weights);
  const std::vector<compare::Counts> shaded =
      compare::countClasses(both.answer, both.truth, pairs, partCount * partCount, seen.weights);
  counts.insert(counts.end(), shaded.begin(), shaded.end());
  return counts;
}

/// The counts of the regions, in the order of judgedRegions.
template <typename Map>
std::vector<compare::Counts> countRegions(const AnswerAndTruth<Map>& both, const ViewCase& seen,
                                          const truth::Truth& truth, const surface::Cage& cage) {
  std::vector<compare::Counts> counts = {
      compare::countSamples(both.answer, both.truth, seen.weights)};
  const auto append = [&](const std::vector<compare::Counts>& more) {
    counts.insert(counts.end(), more.begin(), more.end());
  };
  append(countDisjoint(both, seen, truth));
  append({compare::countSamples(both.answer, both.truth, seen.weights, truth.crossesSeam)});
  if (!cage.partNames.empty()) {
    append(countParts(both, seen, truth, cage.limitFaceParts(), cage.partNames.size()));
  }
  return counts;
}

/// Two answers of a method that do not differ are one mask.
bool isOneMask(const CaseAnswers& answers) {
  return isSame(answers.drawn, answers.test) && isSame(answers.drawnShares, answers.testShares);
}

/// Calls `work` with an answer and the truth's: as maps under a light with a disc, else as masks.
template <typename Work>
void withAnswer(const CaseAnswers& answers, Answer which, const truth::Truth& truth,
                const Work& work) {
  const bool isDrawn = which == Answer::drawn;
  if (truth.isSoft()) {
    work(AnswerAndTruth<Visibility>{isDrawn ? answers.drawnShares : answers.testShares,
                                    truth.visibility});
  } else {
    work(AnswerAndTruth<Mask>{isDrawn ? answers.drawn : answers.test, truth.mask});
  }
}

}  // namespace

OutcomeStage::Shared OutcomeStage::makeShared(const BaseCase& base,
                                              const std::function<void()>& meanwhile) {
  Shared shared;
  const std::shared_ptr<const FieldPoints> points = scene_.fieldPoints(base, view_);
  // Where OpenGL draws in software it compiles on one thread.
  alongside(meanwhile,
            [&] { shared.field = scene_.lightField(base, view_, light_, points.get()); });
  shared.bins = scene_.clock.measure(
      "bins", [&](const Progress&) { return scene_.bins(base, view_, light_); });
  return shared;
}

std::vector<MethodOutcome> OutcomeStage::compareOnOne(
    const BaseCase& base, const std::vector<const CaseAnswers*>& answers,
    const Shared& shared) const {
  const ViewCase& seen = base.views[view_];
  const truth::Truth& truth = seen.truths[light_];
  const std::vector<SampleAxis>& axes = sampleAxes();
  std::vector<MethodOutcome> outcomes(answers.size());
  std::vector<const Mask*> masks;
  std::vector<AnswerOutcome*> places;
  std::vector<std::function<void()>> parts;
  const auto judge = [&](const CaseAnswers& of, Answer which, AnswerOutcome& place) {
    masks.push_back(which == Answer::drawn ? &of.drawn : &of.test);
    places.push_back(&place);
    parts.emplace_back([&, which] {
      withAnswer(of, which, truth, [&](const auto& both) {
        place.regions = countRegions(both, seen, truth, scene_.study.cage);
      });
    });
    if (!truth.isSoft()) return;
    parts.emplace_back([&, which] {
      const Visibility& shares = which == Answer::drawn ? of.drawnShares : of.testShares;
      place.shares = sharesMetrics(shares, truth.visibility, seen.weights, *shared.field);
    });
  };
  const std::vector<std::size_t> firsts = firstOfSame(
      answers.size(),
      [&](std::size_t a, std::size_t b) { return answerAlike(*answers[a], *answers[b]); });
  for (std::size_t m = 0; m < answers.size(); ++m) {
    if (firsts[m] != m) continue;
    const CaseAnswers& own = *answers[m];
    MethodOutcome& outcome = outcomes[m];
    judge(own, Answer::drawn, outcome.drawn);
    if (!isOneMask(own)) judge(own, Answer::test, outcome.test);
    outcome.bins.resize(axes.size());
    for (std::size_t a = 0; a < axes.size(); ++a) {
      parts.emplace_back([&, a] {
        withAnswer(own, Answer::drawn, truth, [&](const auto& both) {
          outcome.bins[a] = compare::countBins(both.answer, both.truth, shared.bins[a],
                                               axes[a].edges.size() + 1, seen.weights);
        });
      });
    }
    parts.emplace_back([&] {
      withAnswer(own, Answer::drawn, truth, [&](const auto& both) {
        outcome.blocks = compare::blockErrors(both.answer, both.truth, cellSide_, seen.weights);
      });
    });
  }
  const std::vector<compare::ShadowLengths> lengths = castLengths(masks, truth, *shared.field);
  std::vector<std::vector<compare::Metric>> boundaries =
      compare::compareBoundaries(masks, truth.mask, seen.layout);
  parallelFor(0, parts.size(), [&](std::size_t i) { parts[i](); });
  for (std::size_t k = 0; k < masks.size(); ++k) {
    places[k]->lengths = lengths[k];
    places[k]->boundaries = std::move(boundaries[k]);
  }
  for (std::size_t m = 0; m < answers.size(); ++m) {
    if (firsts[m] != m) {
      outcomes[m] = outcomes[firsts[m]];
    } else if (isOneMask(*answers[m])) {
      outcomes[m].test = outcomes[m].drawn;
    }
    outcomes[m].otherChartShare = answers[m]->otherChartShare;
  }
  return outcomes;
}

std::vector<MethodOutcome> OutcomeStage::compare(std::span<const ComparedMethod> methods) {
  std::map<const BaseCase*, const BaseCase*> shown;  // whose samples a mesh shows
  std::vector<const BaseCase*> bases;
  for (const ComparedMethod& method : methods) {
    const auto [place, isNew] = shown.try_emplace(method.base, method.base);
    const bool isAtlas = cameraOf(scene_.study.views[view_]) == nullptr;
    if (isNew && isAtlas) {
      const BaseCase* same = baseWithSamples(scene_, *method.base, view_);
      if (same != nullptr) place->second = same;
    }
    appendOnce(bases, place->second);
  }
  std::vector<MethodOutcome> outcomes(methods.size());
  for (const BaseCase* base : bases) {
    std::vector<std::size_t> places;
    for (std::size_t m = 0; m < methods.size(); ++m) {
      if (shown.at(methods[m].base) == base) places.push_back(m);
    }
    std::vector<const CaseAnswers*> answers;
    const Shared shared = makeShared(*base, [&] {
      for (const std::size_t m : places) answers.push_back(&methods[m].answers());
    });
    std::vector<MethodOutcome> found = scene_.clock.measure(
        "compare", [&](const Progress&) { return compareOnOne(*base, answers, shared); });
    for (std::size_t i = 0; i < places.size(); ++i) outcomes[places[i]] = std::move(found[i]);
  }
  return outcomes;
}

}  // namespace gnomon::study
