#include "study/judge/radius_check.h"

#include <fmt/core.h>

#include <cstddef>
#include <utility>
#include <vector>

#include "common/error.h"

namespace gnomon::study {
namespace {

bool isSame(const ClaimRecord& a, const ClaimRecord& b) {
  return a.text == b.text;
}

bool isSame(const DifferenceRecord& a, const DifferenceRecord& b) {
  return a.view == b.view && a.light == b.light && a.first == b.first && a.second == b.second;
}

template <typename Row>
void keep(std::vector<Row>& rows, const std::vector<Row>& half, const std::vector<Row>& twice) {
  bool isMatched = half.size() == rows.size() && twice.size() == rows.size();
  for (std::size_t i = 0; isMatched && i < rows.size(); ++i) {
    isMatched = isSame(rows[i], half[i]) && isSame(rows[i], twice[i]);
    rows[i].radius = {half[i].verdict, twice[i].verdict};
  }
  if (!isMatched) {
    throw InternalError(
        fmt::format("at half and twice the radius: {} and {} rows found, {} alike expected",
                    half.size(), twice.size(), rows.size()));
  }
}

}  // namespace

StudySpec withRadiusTimes(StudySpec study, double factor) {
  for (MethodSpec& method : study.methods) method.bake.settings.radiusTexels *= factor;
  study.thresholds.clear();
  study.leftOut.clear();
  study.ladders.clear();
  return study;
}

void keepRadiusChecks(StudyRecord& record, const StudyRecord& half, const StudyRecord& twice) {
  keep(record.claims, half.claims, twice.claims);
  keep(record.differences, half.differences, twice.differences);
}

void keepRadiusChecks(SweepRecord& sweep, const SweepRecord& half, const SweepRecord& twice) {
  keep(sweep.claims, half.claims, twice.claims);
}

}  // namespace gnomon::study
