#include "study/run/stages/ladder_stage.h"

#include <fmt/core.h>

#include <algorithm>
#include <numeric>

#include "common/error.h"
#include "study/spec/sections/method_section.h"
#include "study/spec/sections/study_paths.h"

namespace gnomon::study {

LadderStage::LadderStage(RunScene& scene, SurfaceOnDemand& surface, RunWriter& writer)
    : scene_(scene), writer_(writer) {
  const StudySpec& study = scene.study;
  if (study.ladders.empty()) return;
  const auto atlas = std::find_if(study.views.begin(), study.views.end(), hasFixedSamples);
  view_ = static_cast<std::size_t>(atlas - study.views.begin());
  for (const LadderSpec& ladder : study.ladders) {
    for (const auto* way : {&ladder.forward, &ladder.backward}) {
      for (const MethodSpec& state : *way) addState(state, surface, ladder.method);
    }
  }
  errors_.resize(study.lights.size());
}

void LadderStage::addState(const MethodSpec& spec, SurfaceOnDemand& surface,
                           const std::string& method) {
  if (stateOf(spec) < states_.size()) return;
  states_.push_back(prepareMethod(scene_, spec, surface));
  if (states_.back().method.needsCamera()) {
    throw InputError(fmt::format("ladder \"{}\": {} {}, a method that answers in an atlas expected",
                                 method, states_.back().method.name,
                                 cameraReason(states_.back().method)));
  }
}

/// Its index, or the number of states.
std::size_t LadderStage::stateOf(const MethodSpec& spec) const {
  const auto found = std::find_if(states_.begin(), states_.end(), [&](const MethodCase& state) {
    return isSameMethod(*state.spec, spec);
  });
  return static_cast<std::size_t>(found - states_.begin());
}

void LadderStage::measure(std::size_t light,
                          const std::vector<std::optional<CaseAnswers>>& answers) {
  const ViewCase& shown = scene_.standardBase().views[*view_];
  tiling_ = compare::chooseTiling(shown.truths.front().mask, shown.weights);
  for (std::size_t s = 0; s < states_.size(); ++s) {
    const ViewCase& seen = states_[s].base->views[*view_];
    const CaseAnswers state = scene_.clock.measure(
        "ladders", [&](const Progress&) { return answersOf(scene_, states_[s], *view_, light); });
    const truth::Truth& truth = seen.truths[light];
    scene_.clock.measure("compare", [&](const Progress&) {
      requireStarts(s, state, answers);
      errors_[light].push_back(state.isSoft()
                                   ? stateErrors(state.drawnShares, truth, seen.weights, tiling_)
                                   : stateErrors(state.drawn, truth, seen.weights, tiling_));
    });
    scene_.clock.measure("writing", [&](const Progress&) {
      writer_.write(maskPath(s, light),
                    state.isSoft() ? writer_.shares(state.drawnShares) : writer_.mask(state.drawn));
    });
  }
}

/// A ladder must begin at the very method that it speaks of.
void LadderStage::requireStarts(std::size_t state, const CaseAnswers& found,
                                const std::vector<std::optional<CaseAnswers>>& answers) const {
  const StudySpec& study = scene_.study;
  for (const LadderSpec& ladder : study.ladders) {
    if (stateOf(ladder.forward.front()) != state) continue;
    const auto method = std::find_if(study.methods.begin(), study.methods.end(),
                                     [&](const MethodSpec& m) { return m.label == ladder.method; });
    const auto& own = answers[static_cast<std::size_t>(method - study.methods.begin())];
    const Mask& mask = found.drawn;
    const bool isEqual =
        own && isSame(own->drawn, mask) && isSame(own->drawnShares, found.drawnShares);
    if (!own || isEqual) continue;
    std::size_t differ = 0;
    for (std::size_t i = 0; i < mask.size(); ++i) {
      differ += own->drawn.samples.at(i) != mask.samples[i] ? 1 : 0;
    }
    throw InputError(fmt::format(
        "ladder \"{}\": its first state and the method differ in {} samples, none expected",
        ladder.method, differ));
  }
}

std::string LadderStage::maskPath(std::size_t state, std::size_t light) const {
  std::vector<std::string> lights;
  for (const Light& spec : scene_.study.lights) lights.push_back(spec.name);
  return fmt::format("masks/ladders/{}_{}.png", fileNames(lights)[light], state);
}

std::vector<BudgetRecord> LadderStage::attribute(const TruthRecord& truth) const {
  std::vector<BudgetRecord> budgets;
  std::vector<std::size_t> lights(scene_.study.lights.size());
  std::iota(lights.begin(), lights.end(), 0);
  for (const LadderSpec& ladder : scene_.study.ladders) {
    scene_.clock.measure("confidence", [&](const Progress&) {
      if (lights.size() > 1) budgets.push_back(attribute(ladder, "all", lights, truth));
      for (const std::size_t light : lights) {
        budgets.push_back(attribute(ladder, scene_.study.lights[light].name, {&light, 1}, truth));
      }
    });
  }
  return budgets;
}

/// Of the states one way, summed over some of the lights.
std::vector<StateErrors> LadderStage::errorsAlong(const std::vector<MethodSpec>& way,
                                                  std::span<const std::size_t> lights) const {
  std::vector<StateErrors> errors;
  for (const MethodSpec& spec : way) {
    const std::size_t state = stateOf(spec);
    errors.push_back(errors_[lights.front()][state]);
    for (const std::size_t light : lights.subspan(1)) errors.back() += errors_[light][state];
  }
  return errors;
}

/// The truth's, mean over some of the lights.
double LadderStage::uncertaintyOf(const TruthRecord& truth,
                                  std::span<const std::size_t> lights) const {
  double sum = 0;
  for (const UncertaintyRecord& flip : truth.flips) {
    const bool isMeant = std::any_of(lights.begin(), lights.end(), [&](std::size_t light) {
      return scene_.study.lights[light].name == flip.light;
    });
    if (flip.view == scene_.study.views[*view_].name && isMeant) sum += flip.flipRate;
  }
  return sum / static_cast<double>(lights.size());
}

BudgetRecord LadderStage::attribute(const LadderSpec& ladder, const std::string& name,
                                    std::span<const std::size_t> lights,
                                    const TruthRecord& truth) const {
  return attributeError(
      ladder, {scene_.study.views[*view_].name, name, uncertaintyOf(truth, lights), tiling_},
      errorsAlong(ladder.forward, lights), errorsAlong(ladder.backward, lights));
}

}  // namespace gnomon::study
