#pragma once

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "study/judge/claims.h"
#include "study/judge/distinguish.h"
#include "study/record/cases.h"

namespace gnomon::test {

/// 10,000 samples, 30 % shadow in the truth, with a given error rate, all of it false light.
inline compare::Counts withErrorRate(double rate) {
  constexpr double samples = 10'000;
  const double wrong = rate * samples;
  return {0.3 * samples - wrong, 0, wrong, 0.7 * samples, static_cast<std::size_t>(samples)};
}

/// Gives a record the intervals of its error rates: as wide as is asked for on either side.
inline void measureIntervals(study::StudyRecord& record, double half) {
  record.confidence.clear();
  record.differences.clear();
  std::vector<study::ResultRecord> rows;
  for (const study::ResultRecord& result : record.results) {
    if (result.region == "all") rows.push_back(result);
  }
  double gains = 0;
  double uncertainties = 0;
  for (std::size_t i = 0; i + 1 < rows.size(); i += 2) {
    const study::ResultRecord& first = rows[i];
    const std::array<double, 2> rates = {
        study::metricOf(first, "error_rate").value.value_or(0),
        study::metricOf(rows[i + 1], "error_rate").value.value_or(0)};
    const auto around = [&](double value) { return compare::Interval{value - half, value + half}; };
    const auto flip = std::find_if(
        record.truth.flips.begin(), record.truth.flips.end(),
        [&](const study::UncertaintyRecord& found) { return found.light == first.light; });
    const double uncertainty =
        flip == record.truth.flips.end() ? record.truth.uncertainty : flip->flipRate;
    const double difference = rates[0] - rates[1];
    gains += difference / (static_cast<double>(rows.size()) / 2);
    uncertainties += uncertainty / (static_cast<double>(rows.size()) / 2);
    record.confidence.push_back(
        {"new", "camera", first.light, rates[0], around(rates[0]), "", 81, 12});
    record.confidence.push_back(
        {"old", "camera", first.light, rates[1], around(rates[1]), "", 81, 12});
    record.differences.push_back(
        {"camera", first.light, "new", "old", difference, around(difference), "", uncertainty,
         study::distinguish({difference, around(difference), uncertainty})});
  }
  const compare::Interval all{gains - half, gains + half};
  record.differences.push_back({"camera", "all", "new", "old", gains, all, "", uncertainties,
                                study::distinguish({gains, all, uncertainties})});
}

/// A study whose methods `new` and `old` have given error rates, one pair a light; intervals are
/// narrow.
inline study::StudyRecord study(const std::string& name,
                                const std::vector<std::pair<double, double>>& rates,
                                double uncertainty) {
  study::StudyRecord record;
  record.name = name;
  record.truth.uncertainty = uncertainty;
  for (std::size_t i = 0; i < rates.size(); ++i) {
    const std::string light = "light " + std::to_string(i);
    record.truth.flips.push_back({"camera", light, uncertainty});
    record.results.push_back({"new", light, "camera", "all", withErrorRate(rates[i].first)});
    record.results.push_back({"old", light, "camera", "all", withErrorRate(rates[i].second)});
    // Regions must not be judged: here the other order holds.
    record.results.push_back({"new", light, "camera", "cast", withErrorRate(0.25)});
    record.results.push_back({"old", light, "camera", "cast", withErrorRate(0.0)});
  }
  measureIntervals(record, 1e-6);
  return record;
}

inline study::ClaimSpec newIsBetter() {
  return {"The new method is better", "§4", "new", "old"};
}

inline study::ClaimRecord judgeClaim(const study::ClaimSpec& claim,
                                     const study::StudyRecord& record) {
  const auto records = study::judgeClaims({claim}, record);
  EXPECT_EQ(records.size(), 1U);
  EXPECT_EQ(records.at(0).text, claim.text);
  EXPECT_EQ(records.at(0).source, claim.source);
  return records.at(0);
}

inline study::SweepRecord sweepOf(const std::vector<study::StudyRecord>& steps) {
  study::SweepRecord sweep;
  sweep.keys = {{"surface.curvature", "curvature"}};
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const study::SweptValue value = study::sweptNumber(0.5 * static_cast<double>(i));
    sweep.cases.push_back({value.text, {value}});
  }
  sweep.steps = steps;
  return sweep;
}

}  // namespace gnomon::test
