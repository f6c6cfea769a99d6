#include "study/judge/ranking.h"

#include "compare/rates.h"

namespace gnomon::study {
namespace {

using Rows = std::vector<const ResultRecord*>;

Mean meanOver(const Rows& rows, compare::MetricId metric) {
  std::vector<std::optional<double>> defined;
  for (const ResultRecord* row : rows) {
    if (const auto value = compare::rate(row->counts, metric).value) defined.emplace_back(value);
  }
  return {meanOf(defined), defined.size()};
}

RankedMethod summarise(const StudyRecord& record, const StudyMeans& study,
                       const RankedOverStudies& place) {
  const Rows rows = rankedRows(record, place.label, Answer::drawn);
  return {place,
          *findMeans(study, place.label),
          meanOver(rows, compare::metrics::iou),
          meanOver(rows, compare::metrics::ber),
          meanOver(rankedRows(record, place.label, Answer::test), compare::metrics::errorRate),
          {}};
}

}  // namespace

std::vector<RankedMethod> rankMethods(const StudyRecord& record) {
  const StudyMeans study = studyMeans(record);
  const std::vector<RankedOverStudies> places = rankOverStudies({&study, 1});
  std::vector<RankedMethod> ranked;
  for (const RankedOverStudies& place : places) {
    ranked.push_back(summarise(record, study, place));
    for (const RankedOverStudies& other : places) {
      const auto difference = differenceIn(study, place.label, other.label);
      if (difference) ranked.back().like.add(other.label, difference->verdict);
    }
  }
  return ranked;
}

}  // namespace gnomon::study
