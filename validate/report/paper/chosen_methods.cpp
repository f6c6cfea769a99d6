#include "report/paper/chosen_methods.h"

#include <algorithm>

#include "common/lists.h"

namespace gnomon::report {
namespace {

/// The rows whose method is among the labels.
template <typename Rows, typename ValueIn>
Rows rowsOf(const Rows& rows, const std::vector<std::string>& labels, const ValueIn& valueIn) {
  Rows kept;
  for (const auto& row : rows) {
    if (contains(labels, valueIn(row))) kept.push_back(row);
  }
  return kept;
}

template <typename Rows>
bool holdsAny(const Rows& methods, const std::vector<std::string>& labels) {
  return std::any_of(methods.begin(), methods.end(),
                     [&](const auto& method) { return contains(labels, method.label); });
}

constexpr auto methodIn = [](const auto& row) { return row.method; };
constexpr auto labelIn = [](const auto& row) { return row.label; };

study::StudyRecord ofMethods(const study::StudyRecord& record,
                             const std::vector<std::string>& labels) {
  study::StudyRecord kept;
  kept.name = record.name;
  kept.title = record.title;
  kept.truth = record.truth;
  kept.atlasViews = record.atlasViews;
  const bool isChoice = holdsAny(record.methods, labels);
  std::vector<std::string> all;
  for (const study::MethodRecord& method : record.methods) all.push_back(method.label);
  const std::vector<std::string>& shown = isChoice ? labels : all;
  kept.methods = rowsOf(record.methods, shown, labelIn);
  kept.results = rowsOf(record.results, shown, methodIn);
  kept.confidence = rowsOf(record.confidence, shown, methodIn);
  kept.cost = rowsOf(record.cost, shown, methodIn);
  return kept;
}

}  // namespace

study::SweepRecord withMethods(const study::SweepRecord& sweep,
                               const std::vector<std::string>& labels) {
  study::SweepRecord kept;
  kept.name = sweep.name;
  kept.title = sweep.title;
  kept.keys = sweep.keys;
  kept.cases = sweep.cases;
  kept.hasStepReports = sweep.hasStepReports;
  for (const study::StudyRecord& step : sweep.steps) {
    kept.steps.push_back(ofMethods(step, labels));
  }
  return kept;
}

}  // namespace gnomon::report
