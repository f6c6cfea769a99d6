#include "study/judge/ranking.h"

#include <set>

#include "compare/rates.h"
#include "study/judge/distinguish.h"
#include "study/judge/study_ranking.h"

namespace gnomon {
namespace {

using Rows = std::vector<const ResultRecord*>;

Mean meanOver(const Rows& rows, std::string_view metric) {
  std::vector<std::optional<double>> defined;
  for (const ResultRecord* row : rows) {
    if (const auto value = rate(row->counts, metric).value) defined.emplace_back(value);
  }
  return {meanOf(defined), defined.size()};
}

RankedMethod summarise(const StudyRecord& record, const RankedOverStudies& place) {
  const Rows rows = rankedRows(record, place.label, Answer::drawn);
  RankedMethod method;
  method.label = place.label;
  method.rank = place.rank;
  method.cases = place.cases;
  method.allCases = place.allCases;
  method.leaderError = place.leaderError;
  method.uncertainty = place.uncertainty;
  method.errorRate = meanOver(rows, "error_rate");
  method.falseShadow = meanOver(rows, "false_shadow");
  method.falseLight = meanOver(rows, "false_light");
  method.iou = meanOver(rows, "iou");
  method.ber = meanOver(rows, "ber");
  method.testError = meanOver(rankedRows(record, place.label, Answer::test), "error_rate");
  std::set<std::string> views;
  for (const ResultRecord* row : rows) views.insert(row->view);
  method.interval = meanInterval(record, place.label, views);
  return method;
}

}  // namespace

std::vector<RankedMethod> rankMethods(const StudyRecord& record) {
  const StudyMeans study = studyMeans(record);
  const std::vector<RankedOverStudies> places = rankOverStudies({&study, 1});
  std::vector<RankedMethod> ranked;
  for (const RankedOverStudies& place : places) {
    ranked.push_back(summarise(record, place));
    for (const RankedOverStudies& other : places) {
      const auto difference = differenceIn(study, place.label, other.label);
      if (difference && difference->verdict == DifferenceVerdict::notDistinguishable) {
        ranked.back().indistinguishable.push_back(other.label);
      }
    }
  }
  return ranked;
}

}  // namespace gnomon
