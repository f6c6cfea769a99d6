#include "study/run/stages/budget.h"

#include <fmt/core.h>

#include <algorithm>
#include <string>

#include "common/error.h"
#include "study/judge/distinguish.h"
#include "truth/region.h"
#include "truth/seam_crossing.h"

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

}  // namespace gnomon::study
