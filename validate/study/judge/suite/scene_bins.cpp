#include "study/judge/suite/scene_bins.h"

#include <algorithm>
#include <map>
#include <utility>

#include "study/record/confidence_record.h"

namespace gnomon::study {
namespace {

/// One axis of a method.
using AxisKey = std::pair<std::string, std::string>;

AxisKey keyOf(const BinRecord& bin) {
  return {bin.method, bin.axis};
}

/// All lights together.
bool isCounted(const BinRecord& bin) {
  return bin.light == allLights && bin.counts.total() > 0;
}

}  // namespace

std::string suiteNameOf(const StudyRecord& record) {
  return record.reproduction.settings["study"]["suite"].value_or(std::string());
}

std::vector<SceneBin> sceneBins(const StudyRecord& record) {
  std::map<AxisKey, std::map<std::string, double>> viewWeights;
  for (const BinRecord& bin : record.bins) {
    if (isCounted(bin)) viewWeights[keyOf(bin)][bin.view] += bin.counts.total();
  }
  std::vector<SceneBin> bins;
  for (const BinRecord& bin : record.bins) {
    if (!isCounted(bin)) continue;
    const auto& views = viewWeights.at(keyOf(bin));
    const double all = views.at(bin.view) * static_cast<double>(views.size());
    auto found = std::find_if(bins.begin(), bins.end(), [&](const SceneBin& other) {
      return other.method == bin.method && other.axis == bin.axis && other.low == bin.low &&
             other.high == bin.high;
    });
    if (found == bins.end()) {
      found = bins.insert(bins.end(), {bin.method, bin.axis, bin.low, bin.high, {}});
    }
    found->share.weight += bin.counts.total() / all;
    found->share.wrong += (bin.counts.falsePositive + bin.counts.falseNegative) / all;
  }
  return bins;
}

}  // namespace gnomon::study
