#include "report/suite/suite_json.h"

#include "report/json/json_values.h"
#include "report/suite/suite_tables.h"
#include "report/text/interval_text.h"
#include "report/text/names.h"

namespace gnomon::report {
namespace {

/// An interval under two keys.
void addInterval(Json& json, const char* low, const char* high,
                 const std::optional<compare::Interval>& interval) {
  json[low] = jsonNumber(lowOf(interval), low);
  json[high] = jsonNumber(highOf(interval), high);
}

Json methodJson(const study::SuiteMethod& method) {
  const auto count = [&](std::size_t compare::SceneRank::*of) {
    return method.rank ? Json((*method.rank).*of) : Json(nullptr);
  };
  const compare::SceneSpread& spread = method.spread;
  Json json = {{"label", method.label},
               {"names", method.names},
               {"rank", count(&compare::SceneRank::rank)},
               {"rank_low", count(&compare::SceneRank::low)},
               {"rank_high", count(&compare::SceneRank::high)},
               {"rank_stability",
                jsonNumber(method.rank ? std::optional(method.rank->stability) : std::nullopt,
                           "methods.rank_stability")},
               {"scenes", spread.scenes},
               {"mean", jsonNumber(spread.mean, "methods.mean")}};
  addInterval(json, "low", "high", method.interval);
  json["reason"] = jsonReason(method.reason);
  json["median"] = jsonNumber(spread.median, "methods.median");
  json["quartile_1"] = jsonNumber(spread.lowerQuartile, "methods.quartile_1");
  json["quartile_3"] = jsonNumber(spread.upperQuartile, "methods.quartile_3");
  json["percentile_95"] = jsonNumber(spread.percentile95, "methods.percentile_95");
  json["worst_twentieth"] = jsonNumber(spread.worstTwentieth, "methods.worst_twentieth");
  json["worst"] = jsonNumber(spread.worst, "methods.worst");
  json["worst_scene"] = method.worstScene;
  json["uncertainty"] = jsonNumber(method.uncertainty, "methods.uncertainty");
  return json;
}

Json pairJson(const study::SuitePair& pair) {
  Json json = {{"first", pair.first},
               {"second", pair.second},
               {"scenes", pair.wins.scenes},
               {"wins", pair.wins.wins},
               {"ties", pair.wins.ties},
               {"win_probability", jsonNumber(pair.wins.probability, "pairs.win_probability")}};
  addInterval(json, "win_low", "win_high", pair.wins.interval);
  json["difference"] = jsonNumber(pair.difference, "pairs.difference");
  addInterval(json, "low", "high", pair.interval);
  json["reason"] = jsonReason(pair.reason);
  json["uncertainty"] = jsonNumber(pair.uncertainty, "pairs.uncertainty");
  json["p"] = jsonNumber(pair.probability, "pairs.p");
  json["p_holm"] = jsonNumber(pair.adjusted, "pairs.p_holm");
  addInterval(json, "corrected_low", "corrected_high", pair.corrected);
  json["verdict"] = differenceVerdictName(pair.verdict);
  return json;
}

Json binJson(const study::SuiteBin& bin) {
  Json json = {{"method", bin.method},
               {"axis", bin.axis},
               {"low", jsonNumber(bin.low, "bins.low")},
               {"high", jsonNumber(bin.high, "bins.high")},
               {"scenes", bin.error.scenes},
               {"weight", jsonNumber(bin.error.weight, "bins.weight")},
               {"error_rate", jsonNumber(bin.error.errorRate, "bins.error_rate")}};
  addInterval(json, "error_low", "error_high", bin.error.interval);
  return json;
}

Json sceneJson(const study::SuiteScene& scene) {
  return {{"name", scene.name},
          {"title", scene.title},
          {"report", scene.report.empty() ? Json(nullptr) : Json(scene.report)},
          {"median", jsonNumber(scene.median, "scenes.median")},
          {"best", scene.best.empty() ? Json(nullptr) : Json(scene.best)},
          {"best_error_rate", jsonNumber(scene.bestError, "scenes.best_error_rate")},
          {"leader_error_rate", jsonNumber(scene.leaderError, "scenes.leader_error_rate")},
          {"uncertainty", jsonNumber(scene.uncertainty, "scenes.uncertainty")}};
}

/// A row a scene × method.
Json resultsJson(const compare::SceneTable& table) {
  Json results = Json::array();
  for (std::size_t s = 0; s < table.scenes.size(); ++s) {
    for (std::size_t m = 0; m < table.methods.size(); ++m) {
      results.push_back({{"scene", table.scenes[s]},
                         {"method", table.methods[m]},
                         {"error_rate", jsonNumber(table.errors[m][s], "results.error_rate")}});
    }
  }
  return results;
}

}  // namespace

std::string suiteJson(const study::SuiteStatistics& statistics, std::string_view command) {
  const Json json = {{"schema", suiteSchema},
                     {"suite", statistics.suite},
                     {"statistic", suiteFigure(statistics).key},
                     {"command", command},
                     {"methods", jsonList(statistics.methods, methodJson)},
                     {"comparisons", statistics.comparisons},
                     {"pairs", jsonList(statistics.pairs, pairJson)},
                     {"bins", jsonList(statistics.bins, binJson)},
                     {"scenes", jsonList(statistics.scenes, sceneJson)},
                     {"results", resultsJson(statistics.table)}};
  return jsonText(json);
}

}  // namespace gnomon::report
