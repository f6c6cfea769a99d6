#include "report/json/ranking_json.h"

#include "report/json/json_values.h"
#include "report/text/names.h"

namespace gnomon::report {
namespace {

Json studyJson(const study::StudyMeans& study) {
  return {{"name", study.name},
          {"title", study.title},
          {"status", jsonStatus(study.status)},
          {"report", study.name + "/report.html"}};
}

Json rankedMethodJson(const study::RankedOverStudies& method) {
  return {{"rank", method.rank ? Json(*method.rank) : Json(nullptr)},
          {"label", method.label},
          {"names", method.names},
          {"studies", method.studies},
          {"cases", method.cases},
          {"all_cases", method.allCases},
          {"mean_error_rate", jsonNumber(method.meanError, "methods.mean_error_rate")},
          {"worst_error_rate", jsonNumber(method.worstError, "methods.worst_error_rate")},
          {"worst_study", method.worstError ? Json(method.worstStudy) : Json(nullptr)},
          {"uncertainty", jsonNumber(method.uncertainty, "methods.uncertainty")},
          {"leader_error_rate", jsonNumber(method.leaderError, "methods.leader_error_rate")},
          {"to_best",
           method.toBest ? Json(differenceVerdictName(method.toBest->verdict)) : Json(nullptr)},
          {"reason", jsonReason(method.toBest ? method.toBest->reason : "")}};
}

Json resultsJson(std::span<const study::StudyMeans> studies) {
  Json results = Json::array();
  for (const study::StudyMeans& study : studies) {
    for (const study::MethodMeans& method : study.methods) {
      Json row = {{"study", study.name}};
      row.update(jsonMeans(method));
      results.push_back(std::move(row));
    }
  }
  return results;
}

Json claimsJson(std::span<const study::StudyMeans> studies) {
  Json claims = Json::array();
  for (const study::StudyMeans& study : studies) {
    for (const study::ClaimRecord& claim : study.claims) {
      Json json = {{"study", study.name}};
      json.update(jsonClaim(claim));
      claims.push_back(std::move(json));
    }
  }
  return claims;
}

}  // namespace

std::string rankingJson(std::span<const study::StudyMeans> studies, std::string_view command) {
  const Json json = {{"schema", rankingSchema},
                     {"status", jsonStatus(study::statusOf(studies))},
                     {"command", command},
                     {"studies", jsonList(studies, studyJson)},
                     {"methods", jsonList(study::rankOverStudies(studies), rankedMethodJson)},
                     {"results", resultsJson(studies)},
                     {"claims", claimsJson(studies)}};
  return jsonText(json);
}

}  // namespace gnomon::report
