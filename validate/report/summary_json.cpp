#include "report/summary_json.h"

#include <nlohmann/json.hpp>

#include "report/names.h"
#include "report/number_text.h"
#include "study/result_metrics.h"

namespace gnomon {
namespace {

using Json = nlohmann::ordered_json;

/// nlohmann writes a number that is not finite as null, without a word.
Json number(double value, std::string_view key) {
  return requireFinite(value, key);
}

Json number(std::optional<double> value, std::string_view key) {
  return value ? number(*value, key) : Json(nullptr);
}

template <typename Records, typename Convert>
Json list(const Records& records, const Convert& convert) {
  Json array = Json::array();
  for (const auto& record : records) array.push_back(convert(record));
  return array;
}

Json studyJson(const StudyRecord& record) {
  return {{"name", record.name},
          {"title", record.title},
          {"source", record.source},
          {"file", record.file},
          {"command", record.command}};
}

Json environmentJson(const EnvironmentRecord& environment) {
  return {{"gnomon_version", environment.gnomonVersion},
          {"commit", environment.commit},
          {"cpu", environment.cpu},
          {"threads", environment.threads},
          {"gl_renderer", environment.glRenderer},
          {"gl_version", environment.glVersion},
          {"embree_version", environment.embreeVersion},
          {"opensubdiv_version", environment.openSubdivVersion}};
}

Json flipJson(const UncertaintyRecord& flip) {
  return {{"view", flip.view},
          {"light", flip.light},
          {"flip_rate", number(flip.flipRate, "truth.flips.flip_rate")},
          {"length_error", number(flip.lengthError, "truth.flips.length_error")}};
}

Json truthJson(const TruthRecord& truth) {
  return {{"micro_triangles", truth.microTriangles},
          {"step_texels", number(truth.stepTexels, "truth.step_texels")},
          {"uncertainty", number(truth.uncertainty, "truth.uncertainty")},
          {"bvh_bytes", truth.bvhBytes},
          {"mesh_bytes", truth.meshBytes},
          {"flips", list(truth.flips, flipJson)}};
}

Json methodJson(const MethodRecord& method) {
  return {{"label", method.label},
          {"name", method.name},
          {"title", method.title},
          {"citation", method.citation}};
}

Json resultJson(const ResultRecord& result) {
  const Counts& counts = result.counts;
  Json json = {{"method", result.method},
               {"light", result.light},
               {"view", result.view},
               {"region", result.region},
               {"samples", counts.samples},
               {"tp", number(counts.truePositive, "results.tp")},
               {"fp", number(counts.falsePositive, "results.fp")},
               {"fn", number(counts.falseNegative, "results.fn")},
               {"tn", number(counts.trueNegative, "results.tn")}};
  Json undefined = Json::object();
  for (const Metric& metric : metricsOf(result)) {
    const std::string name(metric.name);
    json[name] = number(metric.value, name);
    if (!metric.value) undefined[name] = metric.reason;
  }
  json["undefined"] = std::move(undefined);
  return json;
}

Json costJson(const CostRecord& cost) {
  return {{"method", cost.method},
          {"polygons", cost.polygons},
          {"table_bytes", cost.tableBytes},
          {"height_bytes", cost.heightBytes},
          {"frame_ms", number(cost.frameMs, "cost.frame_ms")}};
}

Json timingJson(const TimingRecord& timing) {
  return {{"stage", timing.stage}, {"seconds", number(timing.seconds, "timings.seconds")}};
}

Json thresholdJson(const ThresholdRecord& threshold) {
  return {{"method", threshold.method},
          {"light", threshold.light},
          {"view", threshold.view},
          {"region", threshold.region},
          {"metric", threshold.metric},
          {"value", number(threshold.value, "thresholds.value")},
          {"minimum", number(threshold.minimum, "thresholds.minimum")},
          {"maximum", number(threshold.maximum, "thresholds.maximum")},
          {"passed", threshold.passed}};
}

Json claimJson(const ClaimRecord& claim) {
  return {{"text", claim.text},
          {"source", claim.source},
          {"verdict", verdictName(claim.verdict)},
          {"detail", claim.detail}};
}

Json pictureJson(const PictureRecord& picture) {
  return {{"kind", pictureKindName(picture.kind)},
          {"method", picture.method},
          {"caption", picture.caption},
          {"path", picture.path}};
}

Json panelJson(const PanelRecord& panel) {
  return {{"view", panel.view},
          {"light", panel.light},
          {"width", panel.width},
          {"height", panel.height},
          {"pictures", list(panel.pictures, pictureJson)}};
}

}  // namespace

std::string summaryJson(const StudyRecord& record) {
  const Json json = {{"schema", summarySchema},
                     {"status", record.passed() ? "pass" : "fail"},
                     {"study", studyJson(record)},
                     {"environment", environmentJson(record.environment)},
                     {"truth", truthJson(record.truth)},
                     {"methods", list(record.methods, methodJson)},
                     {"results", list(record.results, resultJson)},
                     {"cost", list(record.cost, costJson)},
                     {"timings", list(record.timings, timingJson)},
                     {"thresholds", list(record.thresholds, thresholdJson)},
                     {"claims", list(record.claims, claimJson)},
                     {"panels", list(record.panels, panelJson)},
                     {"undefined_samples", record.undefinedSamples}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace gnomon
