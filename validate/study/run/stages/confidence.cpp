#include "study/run/stages/confidence.h"

#include <numeric>
#include <utility>

#include "common/parallel.h"
#include "study/judge/distinguish.h"

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

}  // namespace gnomon::study
