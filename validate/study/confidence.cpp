#include "study/confidence.h"

#include <cmath>

#include "common/parallel.h"

namespace gnomon {
namespace {

BlockErrors together(const MethodErrors& method) {
  BlockErrors sum = method.lights.front();
  for (std::size_t l = 1; l < method.lights.size(); ++l) sum += method.lights[l];
  return sum;
}

/// What one interval is of.
struct Sample {
  const std::string* method;
  std::string light;
  BlockErrors cells;
};

ConfidenceRecord recordOf(const ViewErrors& errors, const Sample& of, const Bootstrap& bootstrap) {
  const ConfidenceInterval confidence = rateConfidence(of.cells, errors.tiling, bootstrap);
  return {*of.method,
          errors.view,
          of.light,
          of.cells.rate(),
          confidence.interval,
          std::string(confidence.reason),
          confidence.blocks,
          errors.tiling.blockSide()};
}

}  // namespace

std::vector<ConfidenceRecord> confidenceOf(const ViewErrors& errors) {
  std::vector<Sample> samples;
  for (const MethodErrors& method : errors.methods) {
    samples.push_back({&method.method, std::string(allLights), together(method)});
    if (method.lights.size() < 2) continue;
    for (std::size_t l = 0; l < method.lights.size(); ++l) {
      samples.push_back({&method.method, errors.lights[l], method.lights[l]});
    }
  }
  const Bootstrap bootstrap;
  std::vector<ConfidenceRecord> records(samples.size());
  parallelFor(0, records.size(),
              [&](std::size_t i) { records[i] = recordOf(errors, samples[i], bootstrap); });
  return records;
}

std::vector<DifferenceRecord> differencesOf(const ViewErrors& errors, double uncertainty) {
  std::vector<BlockErrors> sums;
  for (const MethodErrors& method : errors.methods) sums.push_back(together(method));
  std::vector<DifferenceRecord> records;
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t first = 0; first < sums.size(); ++first) {
    for (std::size_t second = first + 1; second < sums.size(); ++second) {
      pairs.emplace_back(first, second);
      records.emplace_back();
    }
  }
  const Bootstrap bootstrap;
  parallelFor(0, records.size(), [&](std::size_t i) {
    const BlockErrors& first = sums[pairs[i].first];
    const BlockErrors& second = sums[pairs[i].second];
    const ConfidenceInterval confidence =
        differenceConfidence(first, second, errors.tiling, bootstrap);
    DifferenceRecord& record = records[i];
    record.view = errors.view;
    record.light = allLights;
    record.first = errors.methods[pairs[i].first].method;
    record.second = errors.methods[pairs[i].second].method;
    record.difference = first.rate() - second.rate();
    record.interval = confidence.interval;
    record.reason = confidence.reason;
    record.uncertainty = uncertainty;
    record.verdict = verdictOn(record.difference, record.interval, uncertainty);
  });
  return records;
}

DifferenceVerdict verdictOn(double difference, const std::optional<Interval>& interval,
                            double uncertainty) {
  if (!interval || interval->holds(0) || std::abs(difference) <= uncertainty) {
    return DifferenceVerdict::notDistinguishable;
  }
  return difference < 0 ? DifferenceVerdict::better : DifferenceVerdict::worse;
}

}  // namespace gnomon
