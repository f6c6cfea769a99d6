#include "report/json/summary_json.h"

#include "report/json/json_values.h"
#include "report/tables/cost_table.h"
#include "report/text/interval_text.h"
#include "report/text/names.h"
#include "study/judge/distinguish.h"
#include "study/record/result_metrics.h"
#include "study/run/stages/budget.h"

namespace gnomon::report {
namespace {

Json methodJson(const study::MethodRecord& method) {
  return {{"label", method.label},
          {"name", method.name},
          {"title", method.title},
          {"citation", method.citation},
          {"family", method.mark.family},
          {"symbol", method.mark.symbol},
          {"other_chart_share", jsonNumber(method.otherChartShare, "methods.other_chart_share")}};
}

Json jsonTexture(const study::TextureRecord& texture) {
  return {{"charts", texture.charts},
          {"charts_overlap", texture.chartsOverlap},
          {"shared_area", jsonNumber(texture.sharedArea, "texture.shared_area")}};
}

Json resultJson(const study::ResultRecord& result) {
  const compare::Counts& counts = result.counts;
  Json json = {{"method", result.method},
               {"light", result.light},
               {"view", result.view},
               {"answer", study::answerName(result.answer)},
               {"region", result.region},
               {"samples", counts.samples},
               {"tp", jsonNumber(counts.truePositive, "results.tp")},
               {"fp", jsonNumber(counts.falsePositive, "results.fp")},
               {"fn", jsonNumber(counts.falseNegative, "results.fn")},
               {"tn", jsonNumber(counts.trueNegative, "results.tn")}};
  addMetrics(json, study::metricsOf(result));
  return json;
}

/// A bin without an end has null there. Its rates are over its own samples.
Json binJson(const study::BinRecord& bin) {
  Json json = {{"method", bin.method},
               {"view", bin.view},
               {"light", bin.light},
               {"axis", bin.axis},
               {"low", jsonNumber(bin.low, "bins.low")},
               {"high", jsonNumber(bin.high, "bins.high")},
               {"samples", bin.counts.samples},
               {"tp", jsonNumber(bin.counts.truePositive, "bins.tp")},
               {"fp", jsonNumber(bin.counts.falsePositive, "bins.fp")},
               {"fn", jsonNumber(bin.counts.falseNegative, "bins.fn")},
               {"tn", jsonNumber(bin.counts.trueNegative, "bins.tn")}};
  for (const compare::MetricId id :
       {compare::metrics::errorRate, compare::metrics::falseShadow, compare::metrics::falseLight}) {
    json[std::string(id.name())] = jsonNumber(compare::rate(bin.counts, id).value, id.name());
  }
  return json;
}

Json costJson(const study::StudyRecord& record, const study::CostRecord& cost) {
  return {{"method", cost.method},
          {"polygons", cost.polygons},
          {"table_bytes", cost.tableBytes},
          {"height_bytes", cost.heightBytes},
          {"frame_ms", jsonNumber(cost.frameMs, "cost.frame_ms")},
          {"still_ms", jsonNumber(cost.stillMs, "cost.still_ms")},
          {"texels", jsonNumber(cost.texels, "cost.texels")},
          {"passes", cost.passes},
          {"frame_ratio", jsonNumber(frameRatio(record, cost), "cost.frame_ratio")},
          {"frame_kept_since", cost.keptSince.empty() ? Json(nullptr) : Json(cost.keptSince)}};
}

Json cacheJson(const std::optional<cache::CacheCounts>& cache) {
  if (!cache) return nullptr;
  return {{"hits", cache->hits}, {"misses", cache->misses}, {"damaged", cache->damaged}};
}

Json timingJson(const study::TimingRecord& timing) {
  return {{"stage", timing.stage}, {"seconds", jsonNumber(timing.seconds, "timings.seconds")}};
}

Json truthFilesJson(const std::optional<study::TruthFilesRecord>& truth) {
  if (!truth) return nullptr;
  return {{"mask", truth->mask},
          {"regions", truth->regions},
          {"seam", truth->seam.empty() ? Json(nullptr) : Json(truth->seam)},
          {"weights", truth->weights.empty() ? Json(nullptr) : Json(truth->weights)}};
}

Json pictureJson(const study::PictureRecord& picture) {
  return {{"kind", pictureKindName(picture.kind)},
          {"method", picture.method},
          {"caption", picture.caption},
          {"path", picture.path},
          {"mask", picture.mask.empty() ? Json(nullptr) : Json(picture.mask)},
          {"test_mask", picture.testMask.empty() ? Json(nullptr) : Json(picture.testMask)},
          {"truth", truthFilesJson(picture.truth)}};
}

Json panelJson(const study::PanelRecord& panel) {
  return {{"view", panel.view},
          {"light", panel.light},
          {"width", panel.width},
          {"height", panel.height},
          {"pictures", jsonList(panel.pictures, pictureJson)}};
}

Json confidenceJson(const study::ConfidenceRecord& confidence) {
  return {{"method", confidence.method},
          {"view", confidence.view},
          {"light", confidence.light},
          {"error_rate", jsonNumber(confidence.rate, "confidence.error_rate")},
          {"low", jsonNumber(lowOf(confidence.interval), "confidence.low")},
          {"high", jsonNumber(highOf(confidence.interval), "confidence.high")},
          {"reason", jsonReason(confidence.reason)},
          {"blocks", confidence.blocks},
          {"block_side", confidence.blockSide}};
}

Json differenceJson(const study::DifferenceRecord& difference) {
  return {{"view", difference.view},
          {"light", difference.light},
          {"first", difference.first},
          {"second", difference.second},
          {"difference", jsonNumber(difference.difference, "differences.difference")},
          {"low", jsonNumber(lowOf(difference.interval), "differences.low")},
          {"high", jsonNumber(highOf(difference.interval), "differences.high")},
          {"reason", jsonReason(difference.reason)},
          {"uncertainty", jsonNumber(difference.uncertainty, "differences.uncertainty")},
          {"verdict", differenceVerdictName(difference.verdict)}};
}

Json shareJson(const study::BudgetShare& share) {
  return {{"share", jsonNumber(share.value, "budget.share")},
          {"low", jsonNumber(lowOf(share.interval), "budget.low")},
          {"high", jsonNumber(highOf(share.interval), "budget.high")},
          {"reason", jsonReason(share.reason)},
          {"distinguishable", study::isDistinguishable(share.verdict)}};
}

Json causeJson(const study::BudgetCause& cause) {
  return {{"cause", cause.name},
          {"change", cause.change},
          {"forward", shareJson(cause.forward)},
          {"backward", shareJson(cause.backward)}};
}

Json stateJson(const study::BudgetState& state) {
  return {{"error_rate", jsonNumber(state.errorRate, "budget.error_rate")},
          {"false_shadow", jsonNumber(state.falseShadow, "budget.false_shadow")},
          {"false_light", jsonNumber(state.falseLight, "budget.false_light")}};
}

Json budgetJson(const study::BudgetRecord& budget) {
  Json json = {
      {"method", budget.method},
      {"view", budget.view},
      {"light", budget.light},
      {"uncertainty", jsonNumber(budget.uncertainty, "budget.uncertainty")},
      {"blocks", budget.blocks},
      {"order_dependence", jsonNumber(study::orderDependence(budget), "budget.order_dependence")},
      {"total", shareJson(budget.total)},
      {"causes", jsonList(budget.causes, causeJson)}};
  for (const study::BudgetRest& rest : budget.rest) json[rest.name] = shareJson(rest.share);
  json["forward_states"] = jsonList(budget.forward, stateJson);
  json["backward_states"] = jsonList(budget.backward, stateJson);
  return json;
}

}  // namespace

std::string summaryJson(const study::StudyRecord& record) {
  const auto [thresholds, references, options] = study::byOrigin(record.judgements);
  const Json json = {
      {"schema", summarySchema},
      {"status", jsonStatus(record.status())},
      {"study", jsonStudy(record)},
      {"environment", jsonEnvironment(record.environment)},
      {"search_radius", jsonRadius(record.radius)},
      {"texture", jsonTexture(record.texture)},
      {"truth", jsonTruth(record.truth)},
      {"methods", jsonList(record.methods, methodJson)},
      {"results", jsonList(record.results, resultJson)},
      {"confidence", jsonList(record.confidence, confidenceJson)},
      {"differences", jsonList(record.differences, differenceJson)},
      {"bins", jsonList(record.bins, binJson)},
      {"cost", jsonList(record.cost,
                        [&](const study::CostRecord& cost) { return costJson(record, cost); })},
      {"timings", jsonList(record.timings, timingJson)},
      {"thresholds", jsonList(thresholds, jsonJudgement)},
      {"baseline", record.baseline.empty() ? Json(nullptr) : Json(record.baseline)},
      {"references", jsonList(references, jsonJudgement)},
      {"problems", jsonList(record.problems, jsonProblem)},
      {"claims", jsonList(record.claims, jsonClaim)},
      {"budget", jsonList(record.budgets, budgetJson)},
      {"panels", jsonList(record.panels, panelJson)},
      {"region_colours", jsonRegionColours()},
      {"notices", record.notices},
      {"undefined_samples", record.undefinedSamples},
      {"cache", cacheJson(record.cache)}};
  return jsonText(json);
}

}  // namespace gnomon::report
