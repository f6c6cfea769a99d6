#include "study/run/stages/budget.h"

#include <fmt/core.h>

#include <algorithm>
#include <string>

#include "common/error.h"
#include "study/judge/distinguish.h"

namespace gnomon::study {
namespace {

BudgetShare shareOf(double value, const compare::ConfidenceInterval& confidence,
                    double uncertainty) {
  return {value, confidence.interval, std::string(confidence.reason),
          isDistinguishable({value, confidence.interval, uncertainty})};
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

}  // namespace

StateErrors& StateErrors::operator+=(const StateErrors& other) {
  wrong += other.wrong;
  distant += other.distant;
  counts += other.counts;
  return *this;
}

StateErrors stateErrors(const Mask& mask, const truth::Truth& truth,
                        const std::vector<double>& weights, const compare::Tiling& tiling) {
  std::vector<std::uint8_t> isDistant(truth.regions.size());
  std::transform(truth.regions.begin(), truth.regions.end(), isDistant.begin(),
                 [](truth::Region region) {
                   return static_cast<std::uint8_t>(region == truth::Region::distant);
                 });
  return {compare::blockErrors(mask, truth.mask, tiling.cellSide, weights),
          compare::blockErrors(mask, truth.mask, tiling.cellSide, weights, isDistant),
          compare::countSamples(mask, truth.mask, weights)};
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
  const StateErrors& last = forward.back();
  record.distant = partOf(last.distant, which);
  record.other = partOf(without(last.wrong, last.distant), which);
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
