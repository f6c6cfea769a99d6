#include "study/run/stages/budget.h"

#include <fmt/core.h>

#include <algorithm>
#include <numeric>

#include "common/error.h"
#include "study/judge/distinguish.h"
#include "study/run/scene/cached_fields.h"
#include "study/run/scene/view_samples.h"
#include "study/spec/sections/method_section.h"
#include "study/spec/sections/study_files.h"
#include "truth/region.h"
#include "truth/surface_paths.h"

namespace gnomon::study {

namespace {

BudgetShare shareOf(double value, const compare::ConfidenceInterval& confidence,
                    double uncertainty) {
  return {value, confidence.interval, std::string(confidence.reason),
          distinguish({value, confidence.interval, uncertainty, confidence.areEqual})};
}

/// A part of the error that is left.
BudgetShare partOf(const compare::BlockErrors& errors, const BudgetCase& which) {
  return shareOf(errors.rate(), compare::rateConfidence(errors, which.tiling), which.uncertainty);
}

BudgetShare stepOf(const StateErrors& before, const StateErrors& after, const BudgetCase& which) {
  return shareOf(before.wrong.rate() - after.wrong.rate(),
                 compare::differenceConfidence(before.wrong, after.wrong, which.tiling),
                 which.uncertainty);
}

compare::BlockErrors without(compare::BlockErrors all, const compare::BlockErrors& part) {
  for (std::size_t i = 0; i < all.wrong.size(); ++i) all.wrong[i] -= part.wrong.at(i);
  return all;
}

/// Where a sample counts: as budgetRestNames.
std::size_t restOf(const truth::Truth& truth, std::size_t sample) {
  if (truth.regions[sample] == truth::Region::global) return 0;
  if (truth.regions[sample] == truth::Region::distant) return 1;
  return !truth.crossesSeam.empty() && truth.crossesSeam[sample] != 0 ? 2 : 3;
}

std::vector<BudgetState> statesOf(const std::vector<StateErrors>& errors) {
  std::vector<BudgetState> states;
  for (const StateErrors& state : errors) {
    const double total = state.counts.total();
    const double scale = total > 0 ? 1 / total : 0;
    states.push_back({state.wrong.rate(), scale * state.counts.falsePositive,
                      scale * state.counts.falseNegative});
  }
  return states;
}

template <typename Map>
StateErrors errorsOf(const Map& answer, const Map& right, const truth::Truth& truth,
                     const std::vector<double>& weights, const compare::Tiling& tiling) {
  StateErrors errors{compare::blockErrors(answer, right, tiling.cellSide, weights),
                     {},
                     compare::countSamples(answer, right, weights)};
  std::vector<std::uint8_t> isIn(truth.regions.size());
  for (std::size_t part = 0; part + 1 < budgetRestNames().size(); ++part) {
    for (std::size_t i = 0; i < isIn.size(); ++i) isIn[i] = restOf(truth, i) == part ? 1 : 0;
    errors.rest.push_back(compare::blockErrors(answer, right, tiling.cellSide, weights, isIn));
  }
  return errors;
}

}  // namespace

const std::vector<std::string_view>& budgetRestNames() {
  static const std::vector<std::string_view> names = {truth::regionName(truth::Region::global),
                                                      truth::regionName(truth::Region::distant),
                                                      truth::seamRegion, "other"};
  return names;
}

StateErrors& StateErrors::operator+=(const StateErrors& other) {
  wrong += other.wrong;
  for (std::size_t part = 0; part < rest.size(); ++part) rest[part] += other.rest.at(part);
  counts += other.counts;
  return *this;
}

StateErrors stateErrors(const Mask& mask, const truth::Truth& truth,
                        const std::vector<double>& weights, const compare::Tiling& tiling) {
  return errorsOf(mask, truth.mask, truth, weights, tiling);
}

StateErrors stateErrors(const Visibility& map, const truth::Truth& truth,
                        const std::vector<double>& weights, const compare::Tiling& tiling) {
  return errorsOf(map, truth.visibility, truth, weights, tiling);
}

BudgetRecord attributeError(const LadderSpec& ladder, const BudgetCase& which,
                            const std::vector<StateErrors>& forward,
                            const std::vector<StateErrors>& backward) {
  const std::size_t causes = ladder.causes.size();
  if (forward.size() != causes + 1 || backward.size() != causes + 1) {
    throw InternalError(fmt::format("ladder {}: {} and {} states found, {} expected", ladder.method,
                                    forward.size(), backward.size(), causes + 1));
  }
  const auto step = [&](const std::vector<StateErrors>& states, std::size_t k) {
    return stepOf(states[k], states[k + 1], which);
  };
  BudgetRecord record;
  record.method = ladder.method;
  record.view = which.view;
  record.light = which.light;
  record.uncertainty = which.uncertainty;
  const compare::ConfidenceInterval total =
      compare::rateConfidence(forward.front().wrong, which.tiling);
  record.blocks = total.blocks;
  record.total = shareOf(forward.front().wrong.rate(), total, which.uncertainty);
  for (std::size_t k = 0; k < causes; ++k) {
    record.causes.push_back({ladder.causes[k].name, ladder.causes[k].change, step(forward, k),
                             step(backward, causes - 1 - k)});
  }
  compare::BlockErrors other = forward.back().wrong;
  for (const compare::BlockErrors& part : forward.back().rest) {
    record.rest.push_back(
        {std::string(budgetRestNames().at(record.rest.size())), partOf(part, which)});
    other = without(std::move(other), part);
  }
  record.rest.push_back({std::string(budgetRestNames().back()), partOf(other, which)});
  record.forward = statesOf(forward);
  record.backward = statesOf(backward);
  return record;
}

double orderDependence(const BudgetRecord& budget) {
  double sum = 0;
  for (const BudgetCause& cause : budget.causes) {
    sum += std::abs(cause.forward.value - cause.backward.value);
  }
  return sum / 2;
}

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
      writer_.write(maskName(s, light),
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

std::string LadderStage::maskName(std::size_t state, std::size_t light) const {
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
