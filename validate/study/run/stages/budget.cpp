#include "study/run/stages/budget.h"

#include <fmt/core.h>

#include <algorithm>
#include <string>

#include "common/error.h"
#include "study/judge/distinguish.h"
#include "study/run/scene/cached_fields.h"
#include "study/run/scene/sample_axes.h"
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
